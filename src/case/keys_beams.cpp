#include "case/keys.hpp"
#include "case/rules.hpp"

// Beams: spokes that carry a torque, bolts, axles.
namespace railwave::case_file {

using scene::Scene;

Section beam_section() {
  using scene::Beam;
  auto section = named_section("beams", "beam", &Scene::beams,
                               "Straight elastic beams that stretch, shear, bend and twist, from one node to one or "
                               "several others: spokes that carry a torque into a wheel, bolts, axles. Where beams "
                               "end, nodes have rotations too: several beams of one node are joined stiffly there; "
                               "solids hold displacements only.");
  section.keys = {
      key("from", &Beam::from, "where they begin: a point, or a node set of one node").names(node_set | point).needed(),
      key("to", &Beam::to, "where they end").names(node_set | point).needed(),
      key("material", &Beam::material, "their material; elastic whatever its yield stress").names(material).needed(),
      key("section", &Beam::section, "shape of the cross-section").one_of({"circle", "rectangle"}),
      key("radius", &Beam::radius, "of a circle").in("m").within(above(0)).otherwise("none: needed for a circle"),
      key("width", &Beam::width, "of a rectangle, across `orientation`")
          .in("m")
          .within(above(0))
          .otherwise("none: needed for a rectangle"),
      key("height", &Beam::height, "of a rectangle, along `orientation`")
          .in("m")
          .within(above(0))
          .otherwise("none: needed for a rectangle"),
      key("orientation", &Beam::orientation,
          "direction across the beams: the height of their section, and the normal of the plane in which `count` beams "
          "are spread")
          .direction()
          .otherwise("the global axis most across each beam"),
      key("count", &Beam::count,
          "number of beams, to the nodes of `to` nearest to as many places evenly around `from`; the first towards "
          "the global axis most across `orientation`")
          .within(at_least(1))
          .otherwise("one to each node of `to`"),
      key("divisions", &Beam::divisions, "elements of each beam, with nodes of their own between")
          .within(between(1, 1000)),
      key("pretension", &Beam::pretension,
          "axial force: held while the scene settles, and what the beam has when it has settled; without [settle] "
          "that of the beam as it lies")
          .in("N")
          .otherwise("no force as it lies"),
  };
  section.rule = check_beam;
  return section;
}

}  // namespace railwave::case_file
