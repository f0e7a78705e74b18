#include "case/field_table.hpp"
#include "case/keys.hpp"
#include "case/rules.hpp"

// Hammer tests: blows, and where the structure's answer is taken; sets of elements for histories and fields.
namespace railwave::case_file {

using scene::Scene;

Section element_set_section() {
  using scene::ElementSet;
  auto section = named_section(
      "element_sets", "element set", &Scene::element_sets,
      "Elements of a part picked by where they are; the set is `part.NAME`, with the part given here, for "
      "`output.field_sets` and `output.history_sets`.");
  section.keys = {
      key("part", &ElementSet::part, "whose elements; parts of tracks count").names(whole_part).needed(),
      key("box", &ElementSet::box,
          "elements whose centre is in it, in the scene's axes with the part at its `position`, undeformed, before any "
          "`close_gap`; the sides count as inside; it may be as large as you like")
          .in("m")
          .within(between(-1e9, 1e9))
          .otherwise("none: give `position`"),
      key("position", &ElementSet::position,
          "instead of a box: the element in which this place lies, in the same axes; where it lies in none, that with "
          "the nearest centre")
          .in("m")
          .otherwise("none: give `box`"),
      key("radius", &ElementSet::radius, "besides, elements whose centre is so near the position")
          .in("m")
          .within(at_least(0)),
      key("surface", &ElementSet::surface, "only elements with a face in this surface of the part, such as z_max")
          .otherwise("any element"),
  };
  section.rule = check_element_set;
  return section;
}

Section hammer_section() {
  using scene::Hammer;
  auto section = named_section("hammers", "hammer", &Scene::hammers,
                               "Blows on a body. Each becomes a node set `part.NAME`, a load NAME (and a curve NAME, "
                               "unless one is given) shared among the set's nodes by "
                               "their mass, and an entry of `output.history_sets`, so that `railwave frf` knows force "
                               "and motion where it strikes. Give what is struck, a part or a track, "
                               "`hourglass = \"stiffness\"`, the default: viscous control damps the waves.");
  section.keys = {
      key("part", &Hammer::part, "what is struck; parts of tracks count").names(whole_part).needed(),
      key("surface", &Hammer::surface, "of the part: only its nodes are struck").otherwise("any node"),
      key("position", &Hammer::position, "middle of the struck patch, in the scene's axes").in("m").needed(),
      key("radius", &Hammer::radius,
          "of the patch; the nearest node is in it however far it is, so 0 is that node alone")
          .in("m")
          .within(at_least(0)),
      key("direction", &Hammer::direction, "of the force").direction(),
      key("peak", &Hammer::peak, "largest force; of a given curve: what that is multiplied by")
          .in("N")
          .within(above(0))
          .mostly(between(1e-3, 1e7))
          .needed(),
      key("start", &Hammer::start, "when the blow begins").in("s").within(at_least(0)),
      key("duration", &Hammer::duration,
          "of the blow, half a sine wave; 0.2 ms excites up to 5 kHz (10 dB less than at 0 Hz there), shorter ones "
          "more")
          .in("s")
          .within(above(0))
          .mostly(between(1e-6, 0.1))
          .otherwise("none: give `curve`"),
      key("curve", &Hammer::curve, "the blow's shape instead, such as a table of a measured one")
          .names(curve)
          .otherwise("half a sine wave"),
  };
  section.rule = check_hammer;
  return section;
}

Section probe_section() {
  using scene::Probe;
  auto section = named_section(
      "probes", "probe", &Scene::probes,
      "Places whose motion, stress or strain is recorded, on a surface or inside a body. Each becomes a set "
      "`part.NAME` and an entry of `output.history_sets`; a row of several `part.NAME_1`, `part.NAME_2` and so "
      "on. Motion is that of the nearest node; stress and strain are those of the element in which the place "
      "lies, constant in it: as at the element's centre.");
  section.keys = {
      key("part", &Probe::part, "the body; parts of tracks count").names(whole_part).needed(),
      key("surface", &Probe::surface, "of the part: only its nodes, and elements with a face in it, count")
          .otherwise("any"),
      key("position", &Probe::position, "of the first, in the scene's axes").in("m").needed(),
      key("radius", &Probe::radius,
          "nodes so near are averaged by mass, elements whose centre is so near by volume; 0 is the nearest node, and "
          "the element in which the place lies")
          .in("m")
          .within(at_least(0)),
      key("count", &Probe::count, "how many").within(between(1, 10000)),
      key("spacing", &Probe::spacing, "from one to the next").in("m").otherwise("none: needed where count is above 1"),
      key("quantities", &Probe::quantities, "what is recorded. " + fields_help(FieldRow::histories))
          .one_of(names_of(fields_for(FieldRow::histories))),
  };
  section.rule = check_probe;
  return section;
}

}  // namespace railwave::case_file
