#include "case/keys.hpp"
#include "case/rules.hpp"

// What there is: materials, meshes, parts, point masses.
namespace railwave::case_file {

using scene::Scene;

Section material_section() {
  using scene::Material;
  auto section = named_section("materials", "material", &Scene::materials, "Linear elastic, isotropic materials.");
  section.keys = {
      key("youngs_modulus", &Material::youngs_modulus, "Young's modulus").in("Pa").within(above(0)).needed(),
      key("poissons_ratio", &Material::poissons_ratio, "Poisson's ratio").within(inside(-1, 0.5)).needed(),
      key("density", &Material::density, "mass per volume").in("kg/m3").within(above(0)).needed(),
  };
  return section;
}

namespace {

std::vector<Key> box_keys() {
  using scene::BoxMesh;
  using scene::MeshSource;
  const auto box = &MeshSource::box;
  return {
      key("origin", box, &BoxMesh::origin, "lowest corner").in("m").only({"box"}),
      key("size", box, &BoxMesh::size, "edge lengths along x, y, z").in("m").within(above(0)).only({"box"}),
      key("divisions", box, &BoxMesh::divisions, "number of elements along x, y, z").within(between(1, 100000)).only({"box"}),
  };
}

std::vector<Key> wheel_keys() {
  using scene::MeshSource;
  using scene::WheelMesh;
  const auto wheel = &MeshSource::wheel;
  return {
      key("profile", wheel, &WheelMesh::profile, "tread profile").one_of({"S1002"}).only({"wheel"}),
      key("radius", wheel, &WheelMesh::radius, "nominal rolling radius, at the tape circle").in("m").within(above(0)).only({"wheel"}),
      key("bore_radius", wheel, &WheelMesh::bore_radius, "radius of the axle's seat").in("m").within(above(0)).only({"wheel"}),
      key("hub_radius", wheel, &WheelMesh::hub_radius, "where the hub's full width ends").in("m").within(above(0)).only({"wheel"}),
      key("hub_width", wheel, &WheelMesh::hub_width, "width of the hub along the axle").in("m").within(above(0)).only({"wheel"}),
      key("web_inner_radius", wheel, &WheelMesh::web_inner_radius, "where the hub's taper has become the web").in("m").within(above(0)).only({"wheel"}),
      key("web_inner_thickness", wheel, &WheelMesh::web_inner_thickness, "thickness of the web at web_inner_radius").in("m").within(above(0)).only({"wheel"}),
      key("web_outer_thickness", wheel, &WheelMesh::web_outer_thickness, "thickness of the web at web_outer_radius").in("m").within(above(0)).only({"wheel"}),
      key("web_outer_radius", wheel, &WheelMesh::web_outer_radius, "where the web begins to widen into the rim").in("m").within(above(0)).only({"wheel"}),
      key("rim_inner_radius", wheel, &WheelMesh::rim_inner_radius, "where the rim has its full width").in("m").within(above(0)).only({"wheel"}),
      key("rim_width", wheel, &WheelMesh::rim_width, "width of the rim along the axle").in("m").within(above(0)).only({"wheel"}),
      key("zone_size", wheel, &WheelMesh::zone_size, "element size in the solution zone").in("m").within(above(0)).only({"wheel"}),
      key("zone_length", wheel, &WheelMesh::zone_length, "rolled arc length that has zone_size").in("m").within(above(0)).only({"wheel"}),
      key("zone_start", wheel, &WheelMesh::zone_start, "arc position where the zone begins: 0 is the wheel's lowest point, positive is rolled on later").in("m").only({"wheel"}),
      key("zone_centre", wheel, &WheelMesh::zone_centre, "lateral position of the contact band's middle, along the profile from the tape circle").in("m").only({"wheel"}),
      key("zone_width", wheel, &WheelMesh::zone_width, "width of the contact band").in("m").within(above(0)).only({"wheel"}),
      key("growth", wheel, &WheelMesh::growth, "largest ratio of neighbouring element sizes away from the zone").within(above_up_to(1, 3)).only({"wheel"}),
      key("coarse_size", wheel, &WheelMesh::coarse_size, "element size far from the zone, at the tread").in("m").within(above(0)).only({"wheel"}),
  };
}

std::vector<Key> rail_keys() {
  using scene::MeshSource;
  using scene::RailMesh;
  const auto rail = &MeshSource::rail;
  return {
      key("section", rail, &RailMesh::section, "rail section").one_of({"54E1"}).only({"rail"}),
      key("inclination", rail, &RailMesh::inclination, "slope by which the rail leans towards -y, the track's centre; 0.025 is 1:40").within(between(-0.2, 0.2)).only({"rail"}),
      key("start", rail, &RailMesh::start, "x of the rail's beginning").in("m").only({"rail"}),
      key("end", rail, &RailMesh::end, "x of the rail's end").in("m").only({"rail"}),
      key("zone_size", rail, &RailMesh::zone_size, "element size in the solution zone").in("m").within(above(0)).only({"rail"}),
      key("zone_start", rail, &RailMesh::zone_start, "x where the solution zone begins").in("m").only({"rail"}),
      key("zone_end", rail, &RailMesh::zone_end, "x where the solution zone ends").in("m").only({"rail"}),
      key("zone_centre", rail, &RailMesh::zone_centre, "y of the contact band's middle").in("m").only({"rail"}),
      key("zone_width", rail, &RailMesh::zone_width, "width of the contact band").in("m").within(above(0)).only({"rail"}),
      key("growth", rail, &RailMesh::growth, "largest ratio of neighbouring element sizes away from the zone").within(above_up_to(1, 3)).only({"rail"}),
      key("coarse_size", rail, &RailMesh::coarse_size, "element size far from the zone").in("m").within(above(0)).only({"rail"}),
  };
}

std::vector<Key> file_keys() {
  using scene::FileMesh;
  using scene::MeshSource;
  const auto file = &MeshSource::file;
  return {
      key("path", file, &FileMesh::path, "mesh of 8-node hexahedra: Abaqus or CalculiX (.inp), Gmsh 4.1 (.msh)").path().needed().only({"file"}),
      key("scale", file, &FileMesh::scale, "multiplies the coordinates: 0.001 for a mesh in mm").within(above(0)).only({"file"}),
  };
}

}  // namespace

Section mesh_section() {
  using scene::MeshSource;
  auto section = named_section("meshes", "mesh", &Scene::meshes, "Meshes of 8-node hexahedra, made by a generator or read from a file.");
  section.keys = {key("type", &MeshSource::type, "what makes the mesh").one_of({"box", "wheel", "rail", "file"}).needed()};
  for (const auto& keys : {box_keys(), wheel_keys(), rail_keys(), file_keys()}) {
    section.keys.insert(section.keys.end(), keys.begin(), keys.end());
  }
  section.rule = check_mesh;
  return section;
}

Section part_section() {
  using scene::Part;
  auto section = named_section("parts", "part", &Scene::parts, "Bodies: a mesh, or an element set of it, made of a material and put in its place.");
  section.required = true;
  section.keys = {
      key("mesh", &Part::mesh, "the part's mesh").names(mesh).needed(),
      key("material", &Part::material, "the part's material").names(material).needed(),
      key("element_set", &Part::element_set, "element set of the mesh that is this part").otherwise("the whole mesh"),
      key("position", &Part::position, "where the mesh's own origin is put").in("m"),
      key("hourglass", &Part::hourglass, "how hourglass modes are resisted: by velocity or by displacement").one_of({"viscous", "stiffness"}),
      key("hourglass_coefficient", &Part::hourglass_coefficient, "how strongly; 0 leaves the modes free").within(between(0, 1)).otherwise("0.1 viscous, 0.05 stiffness"),
  };
  section.rule = check_part;
  return section;
}

Section point_section() {
  using scene::PointMass;
  auto section = named_section("points", "point mass", &Scene::points, "Point masses, moved by connectors, loads and gravity.");
  section.keys = {
      key("mass", &PointMass::mass, "mass").in("kg").within(above(0)).needed(),
      key("position", &PointMass::position, "where it is at the beginning").in("m"),
  };
  return section;
}

}  // namespace railwave::case_file
