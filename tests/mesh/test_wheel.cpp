#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
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

const double pi = std::acos(-1.0);

scene::MeshSource wheel_source() {
  scene::MeshSource source;
  source.name = "wheel";
  source.line = 9;
  source.type = scene::MeshType::wheel;
  source.wheel.zone_centre = 0.005;
  return source;
}

void check_sound(const Mesh& mesh, double zone_size, double least_step, double largest_ratio) {
  const MeshQuality quality = mesh_quality(mesh, 1);
  CHECK(quality.inverted == 0);
  CHECK(quality.jacobian_ratio.value > 0.09);
  CHECK(quality.step.value > least_step * zone_size);
  const Topology found = topology(mesh);
  check_solid(found, 0);
  CHECK(found.largest_size_ratio < largest_ratio);
}

/// Volume of revolution (Pappus) of the exact section's polygon, y to the right and radius up, clockwise.
double exact_volume(const scene::WheelMesh& w) {
  std::vector<Point2> outline;
  const auto add = [&](double y, double r) { outline.push_back({y, r}); };
  for (int i = 0; i <= 13000; ++i) {
    const double s = s1002_first + (s1002_last - s1002_first) * i / 13000;
    add(s, w.radius + s1002_height(s));
  }
  const double field = s1002_first + w.rim_width, c = w.web_centre;
  add(field, w.radius + s1002_height(s1002_last) - (field - s1002_last));
  add(field, w.rim_inner_radius);
  add(c + w.web_outer_thickness / 2, w.web_outer_radius);
  add(c + w.web_inner_thickness / 2, w.web_inner_radius);
  add(c + w.hub_width / 2, w.hub_radius);
  add(c + w.hub_width / 2, w.bore_radius);
  add(c - w.hub_width / 2, w.bore_radius);
  add(c - w.hub_width / 2, w.hub_radius);
  add(c - w.web_inner_thickness / 2, w.web_inner_radius);
  add(c - w.web_outer_thickness / 2, w.web_outer_radius);
  add(s1002_first, w.rim_inner_radius);
  double moment = 0;  // integral of the radius over the section
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point2 a = outline[i], b = outline[(i + 1) % outline.size()];
    moment += (a.y * b.z - b.y * a.z) * (a.z + b.z) / 6;
  }
  return 2 * pi * std::abs(moment);
}

}  // namespace

TEST_CASE("The wheel of the main case is a sound mesh within its budget") {
  const Mesh mesh = wheel_mesh(wheel_source());
  check_sound(mesh, 0.002, 0.75, 4);
  CHECK(mesh.elements.size() < 40000);
}

TEST_CASE("The wheel has the volume of its section turned round the axle") {
  const scene::MeshSource source = wheel_source();
  // Its outline is a polygon: cells of 8 mm, then 4 mm, cut chords off the flange's roundings.
  CHECK_THAT(mesh_quality(wheel_mesh(source), 1).volume, WithinRel(exact_volume(source.wheel), 8e-4));
  scene::MeshSource fine = source;
  fine.wheel.coarse_size = 0.01;
  fine.wheel.core_size = 0.01;
  fine.wheel.section_size = 0.004;
  CHECK_THAT(mesh_quality(wheel_mesh(fine), 1).volume, WithinRel(exact_volume(fine.wheel), 4e-4));
}

TEST_CASE("Every node of the running surface lies on the S1002 profile") {
  const scene::MeshSource source = wheel_source();
  const Mesh mesh = wheel_mesh(source);
  for (const Face& face : mesh.surfaces.at("running_surface"))
    for (int n : mesh.face_nodes(face)) {
      const Vec3& p = mesh.nodes[n];
      CHECK_THAT(radius_of(p), WithinAbs(0.46 + s1002_height(p[1]), 1e-9));
    }
  CHECK(mesh.surfaces.at("tread").size() < mesh.surfaces.at("running_surface").size());
}

TEST_CASE("The wheel's zone lies about the lowest point, rolled towards +x, in the zone's size") {
  const Mesh mesh = wheel_mesh(wheel_source());
  const auto& zone = mesh.element_sets.at("zone");
  CHECK(zone.size() == 15u * 3u * 80u);
  double first = 1, last = -1, low = 1, high = -1;
  for (int e : zone)
    for (int n : mesh.elements[e]) {
      const Vec3& p = mesh.nodes[n];
      const double arc = 0.46 * std::atan2(p[0], -p[2]);
      first = std::min(first, arc), last = std::max(last, arc);
      if (std::abs(radius_of(p) - 0.46 - s1002_height(p[1])) < 1e-9)
        low = std::min(low, p[1]), high = std::max(high, p[1]);
    }
  CHECK_THAT(first, WithinAbs(-0.02, 1e-9));
  CHECK_THAT(last, WithinAbs(0.14, 1e-9));
  CHECK_THAT(low, WithinAbs(0.005 - 0.015, 3e-4));
  CHECK_THAT(high, WithinAbs(0.005 + 0.015, 3e-4));
  const auto [shortest, longest] = edge_range(mesh, zone);
  CHECK(shortest > 0.95 * 0.002);
  CHECK(longest < 1.05 * 0.002);
}

TEST_CASE("Sets of a wheel lie where their names say") {
  const Mesh mesh = wheel_mesh(wheel_source());
  for (int n : mesh.node_sets.at("bore")) CHECK_THAT(radius_of(mesh.nodes[n]), WithinRel(0.0925, widest_growth));
  CHECK(mesh.node_sets.at("centre_section").size() > 300);
  for (int n : mesh.node_sets.at("centre_section")) {
    CHECK_THAT(mesh.nodes[n][0], WithinAbs(0, 1e-9));
    CHECK(mesh.nodes[n][2] < -0.09);
  }
  for (const Face& face : mesh.surfaces.at("tread")) {
    const auto c = mesh.face_nodes(face);
    const Vec3 &a = mesh.nodes[c[0]], &b = mesh.nodes[c[1]], &d = mesh.nodes[c[3]];
    CHECK((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) < 0);  // faces turn outwards, downwards
  }
}

TEST_CASE("A conical wheel has a straight tread") {
  scene::MeshSource source = wheel_source();
  source.wheel.profile = "cone";
  source.wheel.conicity = 0.025;
  const Mesh mesh = wheel_mesh(source);
  check_sound(mesh, 0.002, 0.7, 4);
  for (const Face& face : mesh.surfaces.at("running_surface"))
    for (int n : mesh.face_nodes(face))
      CHECK_THAT(radius_of(mesh.nodes[n]), WithinAbs(0.46 - 0.025 * mesh.nodes[n][1], 1e-9));
}

TEST_CASE("Wheels of other sizes and zones are sound") {
  const auto with = [](auto change) {
    scene::MeshSource source = wheel_source();
    source.wheel.zone_start = 0;
    source.wheel.zone_length = 0.03;
    change(source.wheel);
    return source;
  };
  const std::pair<const char*, scene::MeshSource> cases[] = {
      {"1 mm", with([](auto& w) { w.zone_size = 0.001; })},
      {"4 mm", with([](auto& w) { w.zone_size = 0.004; })},
      {"one layer", with([](auto& w) { w.zone_layers = 1; })},
      {"five layers", with([](auto& w) { w.zone_layers = 5; })},
      {"smaller", with([](auto& w) { w.radius = 0.42, w.rim_inner_radius = 0.36, w.web_outer_radius = 0.33; })},
      {"larger", with([](auto& w) { w.radius = 0.5; })},
      {"long zone", with([](auto& w) { w.zone_size = 0.004, w.zone_length = 1.3; })},
      {"all round",
       with([](auto& w) { w.zone_size = 0.008, w.section_size = 0.009, w.zone_layers = 1, w.zone_length = 2.89; })},
      {"elsewhere", with([](auto& w) { w.zone_start = 0.3, w.zone_length = 0.1; })},
      {"flange root", with([](auto& w) { w.zone_centre = -0.038, w.zone_width = 0.02; })},
      {"narrow band", with([](auto& w) { w.zone_width = 0.01; })},
      {"wide band", with([](auto& w) { w.zone_width = 0.06; })},
      {"five web columns", with([](auto& w) { w.web_columns = 5; })},
      {"no chamfer", with([](auto& w) { w.rim_width = 0.13; })},
      {"fine section", with([](auto& w) { w.section_size = 0.005; })},
  };
  for (const auto& [name, source] : cases) {
    INFO(name);
    check_sound(wheel_mesh(source), source.wheel.zone_size, 0.48, 9);
  }
}

TEST_CASE("Wheel parameters that do not fit are named with what is allowed") {
  const auto complaint = [](auto change) -> std::string {
    scene::MeshSource source = wheel_source();
    change(source.wheel);
    return complaint_of(source);
  };
  CHECK_THAT(complaint([](auto& w) { w.profile = "S1003"; }),
             ContainsSubstring("[meshes.wheel] (line 9): profile = S1003; allowed"));
  CHECK_THAT(complaint([](auto& w) { w.bore_radius = 0.2; }), ContainsSubstring("hub_radius"));
  CHECK_THAT(complaint([](auto& w) { w.radius = 0.4; }), ContainsSubstring("radius = 0.4; allowed: rim_inner_radius"));
  CHECK_THAT(complaint([](auto& w) { w.zone_length = 4; }), ContainsSubstring("circumference, 2.8903 m"));
  CHECK_THAT(complaint([](auto& w) { w.zone_centre = 0.055; }),
             ContainsSubstring("does not lie on the running surface"));
  CHECK_THAT(complaint([](auto& w) { w.web_outer_thickness = 0.2; }), ContainsSubstring("web_outer_thickness"));
  CHECK_THAT(complaint([](auto& w) { w.zone_size = -1, w.growth = 3; }),
             ContainsSubstring("zone_size = -1") && ContainsSubstring("growth = 3"));
}
