#include <iterator>

#include "case/keys.hpp"
#include "case/keys_rail.hpp"
#include "case/rules.hpp"

// The meshes: each type has its own keys, and sets with names of their own.
namespace railwave::case_file {

using scene::BoxMesh;
using scene::CrownedBlockMesh;
using scene::CylinderMesh;
using scene::FileMesh;
using scene::FishplateMesh;
using scene::MeshSource;
using scene::RailPadMesh;
using scene::RingMesh;
using scene::RollerMesh;
using scene::WheelMesh;
using scene::WheelsetMesh;

namespace {

std::vector<Key> box_keys() {
  const auto box = &MeshSource::box;
  return {
      key("origin", box, &BoxMesh::origin, "lowest corner").in("m"),
      key("size", box, &BoxMesh::size, "edge lengths along x, y, z")
          .in("m")
          .within(above(0))
          .mostly(between(1e-6, 1e3)),
      key("divisions", box, &BoxMesh::divisions, "number of elements along x, y, z").within(between(1, 100000)),
  };
}

template <class Mesh>
std::vector<Key> wheel_keys(Mesh MeshSource::*wheel) {
  using Wheel = WheelMesh;
  const auto any = [=](auto name, auto field, auto help) { return key(name, wheel, field, help); };
  const auto position = [=](auto name, auto field, auto help) { return any(name, field, help).in("m"); };
  const auto length = [=](auto name, auto field, auto help) { return position(name, field, help).within(above(0)); };
  return {
      any("profile", &Wheel::profile, "tread profile; `cone` is straight, without flange").one_of({"S1002", "cone"}),
      any("conicity", &Wheel::conicity, "slope of profile `cone`: its radius falls towards +y")
          .within(between(-0.2, 0.2)),
      length("radius", &Wheel::radius, "nominal rolling radius, at the tape circle")
          .within(above_up_to(0, 5))
          .mostly(between(0.1, 1)),
      length("bore_radius", &Wheel::bore_radius, "radius of the axle's seat")
          .within({0.01, 5, true, false})
          .mostly(between(0.02, 0.5)),
      length("hub_radius", &Wheel::hub_radius, "where the hub's full width ends; at least bore_radius + 0.005 m")
          .within(above_up_to(0, 5)),
      length("hub_width", &Wheel::hub_width, "width of the hub along the axle").within(above_up_to(0.01, 0.4)),
      length("web_inner_radius", &Wheel::web_inner_radius, "where the hub's taper has become the web")
          .within(above_up_to(0, 5)),
      length("web_inner_thickness", &Wheel::web_inner_thickness,
             "thickness of the web at web_inner_radius; below hub_width")
          .within({0.003, 0.4, true, true}),
      length("web_outer_thickness", &Wheel::web_outer_thickness,
             "thickness of the web at web_outer_radius; at most 0.6 rim_width")
          .within(above_up_to(0.003, 0.09)),
      length("web_outer_radius", &Wheel::web_outer_radius,
             "where the web begins to widen into the rim; at least web_inner_radius + 0.02 m")
          .within(above_up_to(0, 5)),
      length("rim_inner_radius", &Wheel::rim_inner_radius,
             "where the rim has its full width; the zone's layers and 0.015 m below radius")
          .within(above_up_to(0, 5)),
      length("rim_width", &Wheel::rim_width, "width of the rim along the axle").within(between(0.1, 0.15)),
      position("web_centre", &Wheel::web_centre, "lateral middle of web and hub"),
      length("zone_size", &Wheel::zone_size, "element size in the solution zone").within(between(1e-4, 0.01)),
      length("zone_length", &Wheel::zone_length, "rolled arc length that has zone_size; at most once around")
          .within(above_up_to(0, 32)),
      position("zone_start", &Wheel::zone_start,
               "arc where the zone begins: 0 is the lowest point, positive rolls later"),
      any("zone", &Wheel::zone,
          "where the contact band lies: `given`, by zone_centre and zone_width; `contact`, where its profile and that "
          "of the rail meet with which it has a contact, see zone_lateral_start there")
          .one_of({"given", "contact"}),
      position("zone_centre", &Wheel::zone_centre,
               "middle of the contact band, along the profile from the tape circle"),
      length("zone_width", &Wheel::zone_width, "width of the contact band").within(between(1e-4, 0.15)),
      any("zone_layers", &Wheel::zone_layers, "layers of zone_size below the running surface").within(between(1, 20)),
      position("path_start", &Wheel::path_start,
               "arc where the path begins that the wheel rolls over; surface `tread` reaches as far")
          .otherwise("no path beyond the zone"),
      length("path_length", &Wheel::path_length, "rolled arc length of that path"),
      length("path_size", &Wheel::path_size, "largest element size along the tread on that path, outside the zone")
          .within(between(1e-4, 0.2)),
      any("growth", &Wheel::growth, "largest ratio of neighbouring element sizes").within(between(1.05, 2)),
      length("coarse_size", &Wheel::coarse_size, "largest element size along the tread, far from the zone")
          .within(between(1e-4, 0.2)),
      length("core_size", &Wheel::core_size,
             "largest element size below the tread, as an arc at the tread; at least three times zone_size")
          .within(between(3e-4, 0.5)),
      length("section_size", &Wheel::section_size, "largest element size across the tread; at least zone_size")
          .within(between(0.002, 0.012)),
      any("web_columns", &Wheel::web_columns, "elements through the web's thickness").within(between(1, 9)),
  };
}

std::vector<Key> wheelset_keys() {
  using Wheelset = WheelsetMesh;
  const auto any = [](auto name, auto field, auto help) { return key(name, &MeshSource::wheelset, field, help); };
  std::vector<Key> keys{
      any("half", &Wheelset::half,
          "only the half at y > 0, to the plane of symmetry y = 0; otherwise both, and each set as left_SET (y > 0) "
          "and right_SET too"),
      any("flange_back_distance", &Wheelset::flange_back_distance, "between the inner sides of both wheels")
          .in("m")
          .within(above_up_to(0, 10))
          .mostly(between(0.5, 3)),
      any("axle", &Wheelset::axle,
          "pairs [y in m, radius in m] from the axle's middle at y = 0 outwards, straight lines between; from its "
          "last but one the surface is `journal`; within the hub the axle fills the bore")
          .in("m")
          .pairs_of({"y in m", "radius in m", between(0, 10), between(0.02, 10)})
          .otherwise("[[0, 0.08], [0.61, 0.08], [0.89, 0.0675], [1.1, 0.0675]]"),
      any("axle_size", &Wheelset::axle_size, "largest element size along the axle beside the hub")
          .in("m")
          .within(between(0.005, 0.5)),
  };
  for (auto& one : wheel_keys(&MeshSource::wheelset)) keys.push_back(std::move(one));
  return keys;
}

/// What both generators of graded blocks have.
template <class Mesh>
std::vector<Key> graded_keys(Mesh MeshSource::*mesh, const char* along) {
  const auto length = [=](auto name, auto field, auto help) {
    return key(name, mesh, field, help).in("m").within(above(0));
  };
  return {
      length("zone_size", &Mesh::zone_size, "element size in the solution zone").mostly(between(1e-6, 0.5)),
      key("zone_start", mesh, &Mesh::zone_start, std::string(along) + " where the solution zone begins").in("m"),
      key("zone_end", mesh, &Mesh::zone_end, std::string(along) + " where the solution zone ends").in("m"),
      key("zone_centre", mesh, &Mesh::zone_centre, "y of the solution zone's middle").in("m"),
      length("zone_width", &Mesh::zone_width, "its width along y"),
      key("zone_layers", mesh, &Mesh::zone_layers, "layers of layer_height below the curved surface")
          .within(between(1, 1000)),
      length("layer_height", &Mesh::layer_height, "height of those layers").otherwise("zone_size"),
      key("growth", mesh, &Mesh::growth, "largest ratio of neighbouring element sizes").within(above_up_to(1, 3)),
      length("coarse_size", &Mesh::coarse_size, "largest element size"),
  };
}

std::vector<Key> crowned_block_keys() {
  using Block = CrownedBlockMesh;
  const auto block = &MeshSource::crowned_block;
  std::vector<Key> keys{
      key("origin", block, &Block::origin, "lowest corner; the crest is above x = 0, y = 0").in("m"),
      key("size", block, &Block::size, "lengths along x and y, height at the crest").in("m").within(above(0)),
      key("radius_along", block, &Block::radius_along, "radius of the top's curve along x; 0 is straight")
          .in("m")
          .within(at_least(0)),
      key("radius_across", block, &Block::radius_across, "radius of the top's curve along y; 0 is straight")
          .in("m")
          .within(at_least(0)),
  };
  for (auto& one : graded_keys(block, "x")) keys.push_back(std::move(one));
  return keys;
}

std::vector<Key> roller_keys() {
  using Roller = RollerMesh;
  const auto roller = &MeshSource::roller;
  const auto any = [=](auto name, auto field, auto help) { return key(name, roller, field, help).in("m"); };
  std::vector<Key> keys{
      any("radius", &Roller::radius, "of the tread, at y = 0").within(above(0)).mostly(between(0.005, 5)),
      any("bore_radius", &Roller::bore_radius, "of the bore").within(above(0)),
      any("crown_radius", &Roller::crown_radius, "radius of the tread's curve along y; 0 is straight")
          .within(at_least(0)),
      any("side_start", &Roller::side_start, "y where the roller begins"),
      any("side_end", &Roller::side_end, "y where it ends"),
      key("ring", roller, &Roller::ring, "the whole way round; otherwise a sector"),
      any("arc_start", &Roller::arc_start,
          "where a sector begins: arc at the tread from the lowest point, positive towards +x"),
      any("arc_end", &Roller::arc_end, "where it ends"),
  };
  for (auto& one : graded_keys(roller, "arc")) keys.push_back(std::move(one));
  return keys;
}

std::vector<Key> cylinder_keys() {
  using Cylinder = CylinderMesh;
  const auto any = [](auto name, auto field, auto help) { return key(name, &MeshSource::cylinder, field, help); };
  return {
      any("radius", &Cylinder::radius, "of the bar, whose axis is z")
          .in("m")
          .within(above(0))
          .mostly(between(1e-5, 10)),
      any("length", &Cylinder::length, "along z, from z = 0").in("m").within(above(0)),
      any("core_divisions", &Cylinder::core_divisions, "elements along each side of the square-like core")
          .within(between(1, 1000)),
      any("ring_divisions", &Cylinder::ring_divisions, "elements from the core to the skin").within(between(1, 1000)),
      any("length_divisions", &Cylinder::length_divisions, "layers of elements along z").within(between(1, 100000)),
      any("end_ratio", &Cylinder::end_ratio, "height of the last layer over that of the first")
          .within(between(0.01, 100)),
      any("core_share", &Cylinder::core_share, "half diagonal of the core over the radius").within(between(0.2, 0.8)),
  };
}

std::vector<Key> fishplate_keys() {
  using Plate = FishplateMesh;
  const auto any = [](auto name, auto field, auto help) { return key(name, &MeshSource::fishplate, field, help); };
  const auto position = [=](auto name, auto field, auto help) { return any(name, field, help).in("m"); };
  return {
      any("rail", &Plate::rail, "mesh of the rail in whose fishing chamber it lies, on its facets")
          .names(mesh)
          .needed(),
      any("side", &Plate::side, "which chamber; left is towards -y").one_of({"left", "right"}),
      position("start", &Plate::start, "x of its beginning"),
      position("end", &Plate::end, "x of its end"),
      position("thickness", &Plate::thickness, "beside the web where that is thinnest").within(at_least(0.004)),
      position("clearance", &Plate::clearance, "between web and plate; head and foot are touched")
          .within(between(0, 0.003)),
      position("size", &Plate::size, "of elements along x")
          .within(above(0))
          .otherwise("three times the rail's zone_size; zone_size where the plate reaches the layers of that size "
                     "under the head"),
      position("gap_start", &Plate::gap_start,
               "x where a gap between rails begins that it bridges: there `fishing` ends")
          .otherwise("no gap"),
      position("gap_end", &Plate::gap_end, "x where that gap ends: there `fishing_2` begins").otherwise("no gap"),
  };
}

std::vector<Key> rail_pad_keys() {
  using Pad = RailPadMesh;
  const auto any = [](auto name, auto field, auto help) { return key(name, &MeshSource::rail_pad, field, help); };
  return {
      any("rail", &Pad::rail,
          "mesh of the rail under whose foot it lies, as wide as that and leaning with it; its lines are those of the "
          "foot's elements")
          .names(mesh)
          .needed(),
      any("start", &Pad::start, "x of its beginning").in("m"),
      any("end", &Pad::end, "x of its end").in("m"),
      any("thickness", &Pad::thickness, "everywhere").in("m").within(above(0)),
      any("layers", &Pad::layers, "elements through the thickness").within(between(1, 100)),
      any("size", &Pad::size, "largest element along and across the rail: the foot's are parted")
          .in("m")
          .within(above(0))
          .otherwise("as the foot's are"),
  };
}

std::vector<Key> ring_keys() {
  using Ring = RingMesh;
  const auto any = [](auto name, auto field, auto help) { return key(name, &MeshSource::ring, field, help); };
  const auto length = [=](auto name, auto field, auto help) { return any(name, field, help).in("m").within(above(0)); };
  return {
      length("inner_radius", &Ring::inner_radius, "of the hollow").mostly(between(1e-5, 10)),
      length("outer_radius", &Ring::outer_radius, "of the ring, whose axis is y").mostly(between(1e-5, 10)),
      length("width", &Ring::width, "along y, half of it to each side of y = 0"),
      any("round_divisions", &Ring::round_divisions, "elements round the ring").within(between(8, 100000)),
      any("wall_divisions", &Ring::wall_divisions, "elements from the inner to the outer side")
          .within(between(1, 1000)),
      any("width_divisions", &Ring::width_divisions, "layers of elements along y").within(between(1, 100000)),
  };
}

std::vector<Key> file_keys() {
  const auto file = &MeshSource::file;
  return {
      key("path", file, &FileMesh::path, "8-node hexahedra: Abaqus or CalculiX (.inp), Gmsh 4.1 (.msh)")
          .path()
          .needed(),
      key("scale", file, &FileMesh::scale, "multiplies the coordinates: 0.001 for a mesh in mm")
          .within(between(1e-12, 1e12)),
  };
}

}  // namespace

Section mesh_section() {
  auto section = named_section("meshes", "mesh", &scene::Scene::meshes,
                               "Meshes of 8-node hexahedra, made by a generator or read from a file.");
  section.keys = {key("type", &MeshSource::type, "what makes it")
                      .one_of({std::begin(scene::mesh_type_names), std::end(scene::mesh_type_names)})
                      .needed()};
  section.add_keys("box", box_keys());
  section.add_keys("wheel", wheel_keys(&MeshSource::wheel));
  section.add_keys("rail", rail_keys(&MeshSource::rail));
  section.add_keys("file", file_keys());
  section.add_keys("crowned_block", crowned_block_keys());
  section.add_keys("roller", roller_keys());
  section.add_keys("cylinder", cylinder_keys());
  section.add_keys("fishplate", fishplate_keys());
  section.add_keys("rail_pad", rail_pad_keys());
  section.add_keys("wheelset", wheelset_keys());
  section.add_keys("ring", ring_keys());
  section.rule = check_mesh;
  return section;
}

std::vector<MeshSets> mesh_sets() {
  return {
      {"box", "`x_min`, `x_max`, `y_min`, `y_max`, `z_min`, `z_max`", "the same six", ""},
      {"crowned_block", "`x_min`, `x_max`, `y_min`, `y_max`, `bottom`, `top`", "the same six, `zone`", ""},
      {"roller", "`y_min`, `y_max`, `tread`, `bore`; unless it is a ring, `arc_min`, `arc_max`", "the same, `zone`",
       ""},
      {"ring", "`y_min`, `y_max`, `inner`, `outer`", "the same four", ""},
      {"cylinder", "`z_min`, `z_max`, `skin`", "the same three", ""},
      {"wheel", "`bore`, `centre_section`", "`tread`, `running_surface`", "`zone`"},
      {"wheelset", "as `wheel`, `middle`", "as `wheel`, `middle`, `axle_end`, `journal`, `skin` of the axle",
       "`zone`, `wheel`, `axle`"},
      {"rail", "`foot`, `start`, `end`",
       "`head`, `running_surface`, `foot`, `fishing_left`, `fishing_right`, `start_face`, `end_face`", "`zone`"},
  };
}

Section seam_section() {
  using scene::Seam;
  auto section = named_section("seams", "seam", &scene::Scene::seams,
                               "Cracks: on a plane across the rail the faces of elements come apart, as surfaces "
                               "`part.NAME_before` and `part.NAME_behind` for a contact. "
                               "The mesh's layers across x are bent onto the plane; the crack consists of whole faces, "
                               "so that its length and depth are met to an element's size.");
  section.keys = {
      key("mesh", &Seam::mesh, "mesh that it is in; all parts of that mesh have it").names(mesh).needed(),
      key("place", &Seam::place, "middle of its mouth on the mesh's upper surface, in the mesh's own axes")
          .in("m")
          .needed(),
      key("length", &Seam::length, "along y, half of it to each side; more than the mesh is wide: all through")
          .in("m")
          .within(above(0))
          .needed(),
      key("depth", &Seam::depth, "along its plane").in("m").within(above(0)).needed(),
      key("angle", &Seam::angle, "between its plane and the vertical; positive: its deeper parts lie farther along x")
          .in("rad")
          .within(between(-1.2, 1.2)),
      key("width", &Seam::width,
          "between its faces, square to its plane; elements beside it become shorter by half of that each, and it "
          "closes "
          "within its last element; what `bridged_gap` of a contact has is crossed")
          .in("m")
          .within(between(0, 0.005)),
  };
  return section;
}

}  // namespace railwave::case_file
