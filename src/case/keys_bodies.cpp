#include <fmt/format.h>

#include "case/keys.hpp"
#include "case/rules.hpp"

// What there is, besides meshes: materials, parts, point masses.
namespace railwave::case_file {

using scene::Scene;

namespace {

void check_material(void* entry, EntryCheck& check) {
  const auto& material = *static_cast<scene::Material*>(entry);
  if (check.given("tangent_modulus") && !check.given("yield_stress")) {
    check.complain("tangent_modulus",
                   "has no effect without yield_stress; give that too, or leave tangent_modulus out");
  }
  if (check.given("hardening_beta") && !check.given("tangent_modulus")) {
    check.complain("hardening_beta",
                   "has no effect without tangent_modulus; give that too, or leave hardening_beta out");
  }
  for (const char* key : {"isotropic_saturation", "back_stress_modulus"}) {
    if (!check.given(key)) continue;
    if (!check.given("yield_stress"))
      check.complain(key, fmt::format("has no effect without yield_stress; give that too, or leave {} out", key));
    if (check.given("tangent_modulus"))
      check.complain(key, fmt::format("is one law of hardening and tangent_modulus another; leave {} or "
                                      "tangent_modulus out",
                                      key));
  }
  if (check.given("isotropic_saturation") != check.given("isotropic_rate"))
    check.complain(check.given("isotropic_rate") ? "isotropic_rate" : "isotropic_saturation",
                   "isotropic_saturation and isotropic_rate are one law; give both or neither");
  if (check.given("back_stress_recall") && !check.given("back_stress_modulus"))
    check.complain("back_stress_recall",
                   "has no effect without back_stress_modulus; give that too, or leave back_stress_recall out");
  if (check.sound({"isotropic_saturation", "yield_stress"}) && material.yield_stress &&
      !(material.isotropic_saturation > -*material.yield_stress))
    check.complain("isotropic_saturation",
                   fmt::format("is {} Pa: with that nothing is left of yield_stress ({} Pa) in the end",
                               material.isotropic_saturation, *material.yield_stress));
  if (check.sound({"tangent_modulus", "youngs_modulus"}) && material.tangent_modulus > 0 &&
      !(material.tangent_modulus < material.youngs_modulus)) {
    check.complain("tangent_modulus", fmt::format("is {}, must be smaller than youngs_modulus ({})",
                                                  material.tangent_modulus, material.youngs_modulus));
  }
}

}  // namespace

Section material_section() {
  using scene::Material;
  auto section =
      named_section("materials", "material", &Scene::materials, "Isotropic materials, elastic or elastoplastic.");
  section.keys = {
      key("youngs_modulus", &Material::youngs_modulus, "Young's modulus")
          .in("Pa")
          .within(above(0))
          .mostly(between(5e5, 1.5e12))
          .needed(),
      key("poissons_ratio", &Material::poissons_ratio,
          "Poisson's ratio; towards 0.5 waves grow without limit, and steps go to 0")
          .within(between(-0.999, 0.4999))
          .mostly(between(-0.999, 0.495))
          .needed(),
      key("density", &Material::density, "mass per volume")
          .in("kg/m3")
          .within(above(0))
          .mostly(between(20, 25e3))
          .needed(),
      key("yield_stress", &Material::yield_stress,
          "von Mises stress at which the material begins to flow, with linear hardening beyond")
          .in("Pa")
          .within(above(0))
          .otherwise("no yield"),
      key("tangent_modulus", &Material::tangent_modulus,
          "slope of true stress over logarithmic strain beyond yield, under tension; below youngs_modulus")
          .in("Pa")
          .within(at_least(0)),
      key("hardening_beta", &Material::hardening_beta,
          "share of the hardening that widens the yield surface; the rest moves it: 1 is isotropic, 0 kinematic "
          "(Prager), between is mixed")
          .within(between(0, 1)),
      key("isotropic_saturation", &Material::isotropic_saturation,
          "Q of a flow stress that grows, or with Q < 0 falls, by Q (1 - exp(-b p)) with the equivalent plastic "
          "strain p (Voce)")
          .in("Pa"),
      key("isotropic_rate", &Material::isotropic_rate, "b of that").within(at_least(0)),
      key("back_stress_modulus", &Material::back_stress_modulus,
          "C of a yield surface that moves by db = 2/3 C de_p - gamma b dp (Armstrong and Frederick, Chaboche)")
          .in("Pa")
          .within(at_least(0)),
      key("back_stress_recall", &Material::back_stress_recall, "gamma of that: the surface moves by C / gamma at most")
          .within(at_least(0)),
  };
  section.rule = check_material;
  return section;
}

Section part_section() {
  using scene::Part;
  auto section = named_section("parts", "part", &Scene::parts,
                               "Bodies: a mesh, or an element set of it, made of a material and put in its place.");
  section.required = true;
  section.keys = {
      key("mesh", &Part::mesh, "the part's mesh").names(mesh).needed(),
      key("material", &Part::material, "the part's material").names(material).needed(),
      key("element_set", &Part::element_set,
          "element set of the mesh that is this part; parts of one mesh are bodies of their own, which [ties.NAME] "
          "join where they meet")
          .otherwise("the whole mesh"),
      key("position", &Part::position, "where the mesh's own origin is put").in("m"),
      key("mirror", &Part::mirror, "the mesh is mirrored at its plane y = 0; its sets keep their names"),
      key("angle_of_attack", &Part::angle_of_attack,
          "the mesh is turned by this angle about the vertical axis through its origin, from x to y: a wheel at y > "
          "0 then steers to its flange. Boxes of [node_sets] see it unturned; angular velocities of [initial_motion] "
          "and axes of torques on it turn along")
          .in("rad")
          .within(between(-0.2, 0.2)),
      key("hourglass", &Part::hourglass,
          "how hourglass modes are resisted: by velocity, which takes their energy, or by displacement, which stores "
          "it and gives it back; docs/hourglass.md")
          .one_of({"viscous", "stiffness"}),
      key("hourglass_coefficient", &Part::hourglass_coefficient, "how strongly; 0 leaves the modes free")
          .within(between(0, 1))
          .otherwise("0.05; 0.1 viscous"),
      key("mass_damping", &Part::mass_damping,
          "Rayleigh's alpha: a force of alpha times mass and velocity against each node's velocity, which slows "
          "rigid motion too: not for bodies that roll or travel")
          .in("1/s")
          .within(at_least(0)),
      key("stiffness_damping", &Part::stiffness_damping,
          "Rayleigh's beta: viscous stress of beta times the elastic stress of the strain rate; a mode of angular "
          "frequency w is damped by beta w/2 of critical; shortens the stable step from dt to sqrt(dt^2 + beta^2) - "
          "beta")
          .in("s")
          .within(at_least(0))
          .mostly(between(0, 0.01)),
      key("linear_bulk_viscosity", &Part::linear_bulk_viscosity,
          "pressure Q2 rho c l |d| where volume shrinks at the rate d, l the cube root of an element's volume; 0.06 is "
          "usual for shocks")
          .within(between(0, 2)),
      key("quadratic_bulk_viscosity", &Part::quadratic_bulk_viscosity,
          "pressure Q1 rho l^2 d^2 where volume shrinks at the rate d; 1.5 is usual for shocks")
          .within(between(0, 10)),
  };
  section.rule = check_part;
  return section;
}

Section point_section() {
  using scene::PointMass;
  auto section =
      named_section("points", "point mass", &Scene::points, "Point masses, moved by connectors, loads and gravity.");
  section.keys = {
      key("mass", &PointMass::mass, "mass; may be 0 where beams end, which give it theirs")
          .in("kg")
          .within(at_least(0))
          .needed(),
      key("position", &PointMass::position, "where it is at the beginning").in("m"),
  };
  return section;
}

}  // namespace railwave::case_file
