#include "case/keys.hpp"
#include "case/rules.hpp"

// What there is, besides meshes: materials, parts, point masses.
namespace railwave::case_file {

using scene::Scene;

Section material_section() {
  using scene::Material;
  auto section = named_section("materials", "material", &Scene::materials, "Isotropic materials, elastic or elastoplastic.");
  section.keys = {
      key("youngs_modulus", &Material::youngs_modulus, "Young's modulus").in("Pa").within(above(0)).needed(),
      key("poissons_ratio", &Material::poissons_ratio, "Poisson's ratio").within(inside(-1, 0.5)).needed(),
      key("density", &Material::density, "mass per volume").in("kg/m3").within(above(0)).needed(),
      key("yield_stress", &Material::yield_stress,
          "von Mises stress at which the material begins to flow, with isotropic hardening beyond")
          .in("Pa")
          .within(above(0))
          .otherwise("elastic without end"),
      key("tangent_modulus", &Material::tangent_modulus,
          "slope of true stress over logarithmic strain beyond yield, under tension; below youngs_modulus")
          .in("Pa")
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
      key("element_set", &Part::element_set, "element set of the mesh that is this part").otherwise("the whole mesh"),
      key("position", &Part::position, "where the mesh's own origin is put").in("m"),
      key("hourglass", &Part::hourglass, "how hourglass modes are resisted: by velocity or by displacement")
          .one_of({"viscous", "stiffness"}),
      key("hourglass_coefficient", &Part::hourglass_coefficient, "how strongly; 0 leaves the modes free")
          .within(between(0, 1))
          .otherwise("0.1 viscous, 0.05 stiffness"),
  };
  section.rule = check_part;
  return section;
}

Section point_section() {
  using scene::PointMass;
  auto section =
      named_section("points", "point mass", &Scene::points, "Point masses, moved by connectors, loads and gravity.");
  section.keys = {
      key("mass", &PointMass::mass, "mass").in("kg").within(above(0)).needed(),
      key("position", &PointMass::position, "where it is at the beginning").in("m"),
  };
  return section;
}

}  // namespace railwave::case_file
