#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/generators/wheel.hpp"
#include "mesh/quality.hpp"
#include "mesh/sections/profiles.hpp"
#include "round_bodies.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource coarse(bool half) {
  scene::MeshSource source;
  source.name = "wheelset";
  source.line = 7;
  source.type = scene::MeshType::wheelset;
  auto& w = source.wheelset;
  w.half = half;
  w.zone_size = 0.004;
  w.zone_centre = 0.005;
  w.section_size = 0.012;
  w.web_columns = 2;
  w.zone_layers = 1;
  w.growth = 1.5;
  return source;
}

void check_sound(const Mesh& mesh, double zone_size, int euler) {
  const MeshQuality quality = mesh_quality(mesh, 1);
  CHECK(quality.inverted == 0);
  CHECK(quality.jacobian_ratio.value > 0.09);
  CHECK(quality.step.value > 0.48 * zone_size);
  const Topology found = topology(mesh);
  check_solid(found, euler);
}

}  // namespace

TEST_CASE("Half a wheelset is a wheel whose bore an axle fills, one sound solid with the volume of both") {
  const scene::MeshSource source = coarse(true);
  const Mesh mesh = build_mesh(source);
  check_sound(mesh, 0.004, 2);
  scene::MeshSource wheel = source;
  wheel.type = scene::MeshType::wheel;
  wheel.wheel = source.wheelset;
  const double around = static_cast<double>(wheel_stations(source.wheelset).levels.back().size());
  CAPTURE(around, mesh.elements.size(), mesh.element_sets.at("axle").size());
  CHECK_THAT(mesh_quality(mesh, 1).volume - mesh_quality(wheel_mesh(wheel), 1).volume,
             WithinRel(axle_volume(source.wheelset), 1e-6));
  CHECK(mesh.element_sets.at("wheel").size() + mesh.element_sets.at("axle").size() == mesh.elements.size());
}

TEST_CASE("The axle's quality and steps do not suffer from a fine zone") {
  for (double size : {0.001, 0.002, 0.008}) {
    CAPTURE(size);
    scene::MeshSource source = coarse(true);
    source.wheelset.zone_size = size;
    source.wheelset.zone_length = 0.3;
    const Mesh mesh = build_mesh(source);
    check_sound(mesh, size, 2);
    Mesh axle = mesh;
    axle.elements.clear();
    for (int e : mesh.element_sets.at("axle")) axle.elements.push_back(mesh.elements[e]);
    const MeshQuality quality = mesh_quality(axle, 1);
    INFO("axle: step " << quality.step.value << ", Jacobians " << quality.jacobian_ratio.value);
    // The wheel's own worst element has 0.7 of its zone's; beyond zones of 4 mm the axle's section is the finer one.
    CHECK(quality.step.value > 0.7 * std::min(size, 0.004));
    CHECK(quality.jacobian_ratio.value > 0.3);
  }
}

TEST_CASE("Wheels stand at the flange-back distance, flanges inside; sets lie where their names say") {
  const Mesh mesh = build_mesh(coarse(false));
  check_sound(mesh, 0.004, 2);
  double inner = 1e300;
  for (int e : mesh.element_sets.at("left_wheel"))
    for (int n : mesh.elements[e])
      if (radius_of(mesh.nodes[n]) > 0.3) inner = std::min(inner, mesh.nodes[n][1]);
  CHECK_THAT(inner, WithinAbs(0.68, 1e-9));
  for (const char* side : {"left_", "right_"}) {
    const double sign = side[0] == 'l' ? 1 : -1;
    const auto set = [&](const char* name) { return side + std::string(name); };
    for (const Face& face : mesh.surfaces.at(set("tread")))
      for (int n : mesh.face_nodes(face)) {
        const double y = sign * mesh.nodes[n][1] - 0.75;
        CHECK_THAT(radius_of(mesh.nodes[n]), WithinAbs(0.46 + s1002_height(y), 1e-9));
      }
    for (int n : mesh.node_sets.at(set("bore"))) {
      CHECK_THAT(radius_of(mesh.nodes[n]), WithinRel(0.0925, widest_growth));
      CHECK(sign * mesh.nodes[n][1] > 0.657);
    }
    for (const Face& face : mesh.surfaces.at(set("axle_end")))
      for (int n : mesh.face_nodes(face)) CHECK_THAT(mesh.nodes[n][1], WithinAbs(sign * 1.1, 1e-12));
    for (const Face& face : mesh.surfaces.at(set("journal")))
      for (int n : mesh.face_nodes(face)) {
        CHECK_THAT(radius_of(mesh.nodes[n]), WithinRel(0.0675, widest_growth));
        CHECK(sign * mesh.nodes[n][1] > 0.89 - 1e-9);
      }
  }
  CHECK(mesh.surfaces.count("middle") == 0);
  for (int n : mesh.node_sets.at("middle")) CHECK(mesh.nodes[n][1] == 0);
  const Mesh half = build_mesh(coarse(true));
  CHECK(half.surfaces.at("middle").size() > 20);
  CHECK(mesh.elements.size() == 2 * half.elements.size());
  CHECK(mesh.nodes.size() == 2 * half.nodes.size() - half.node_sets.at("middle").size());
  CHECK(mesh.surfaces.at("tread").size() == 2 * half.surfaces.at("tread").size());
  CHECK_THAT(mesh_quality(mesh, 1).volume, WithinRel(2 * mesh_quality(half, 1).volume, 1e-12));
}

TEST_CASE("Parameters of a wheelset that do not fit are named with what is allowed") {
  const auto complaint = [](auto change) -> std::string {
    scene::MeshSource source = coarse(true);
    change(source.wheelset);
    return complaint_of(source);
  };
  CHECK(complaint([](auto&) {}).empty());
  CHECK_THAT(complaint([](auto& w) { w.axle[1][0] = 0.7; }),
             ContainsSubstring("[meshes.wheelset] (line 7): axle = [0.7, 0.08]; allowed: a y outside the hub, which "
                               "goes from 0.6575 to 0.8375 m"));
  CHECK_THAT(complaint([](auto& w) { w.axle[0][0] = 0.1; }), ContainsSubstring("allowed: a first pair at y = 0"));
  CHECK_THAT(complaint([](auto& w) { w.axle.pop_back(), w.axle.pop_back(); }),
             ContainsSubstring("a last pair beyond the hub's end, y = 0.8375 m"));
  CHECK_THAT(complaint([](auto& w) { w.flange_back_distance = 0.05; }),
             ContainsSubstring("flange_back_distance = 0.05"));
  CHECK_THAT(complaint([](auto& w) { w.bore_radius = 0.2; }), ContainsSubstring("hub_radius"));
}
