#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/quality.hpp"
#include "round_bodies.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource roller() {
  scene::MeshSource source;
  source.name = "roller";
  source.line = 6;
  source.type = scene::MeshType::roller;
  return source;
}

void check_sound(const Mesh& mesh, int euler) {
  const MeshQuality quality = mesh_quality(mesh, 1);
  CHECK(quality.inverted == 0);
  CHECK(quality.jacobian_ratio.value > 0.5);
  const Topology found = topology(mesh);
  check_solid(found, euler);
  CHECK(found.largest_size_ratio < 1.4);
}

}  // namespace

TEST_CASE("A roller's tread is a cylinder, or a sphere where its crown has its own radius, exact at every node") {
  for (const bool ring : {false, true})
    for (const double crown : {0.0, 0.46, 0.2}) {
      CAPTURE(ring, crown);
      scene::MeshSource source = roller();
      source.roller.ring = ring;
      source.roller.crown_radius = crown;
      const Mesh mesh = build_mesh(source);
      check_sound(mesh, ring ? 0 : 2);
      for (int n : mesh.node_sets.at("tread")) {
        const auto [x, y, z] = mesh.nodes[n];
        if (crown == 0)
          CHECK_THAT(std::hypot(x, z), WithinAbs(0.46, 1e-14));
        else
          CHECK_THAT(std::hypot(std::hypot(x, z) - (0.46 - crown), y), WithinAbs(crown, 1e-14));
      }
      for (int n : mesh.node_sets.at("bore"))
        // A ring's bore takes what the chords of the tread's cells of 10 mm lack: a^2 / 12 (R^2 - r^2) / r and more.
        CHECK_THAT(radius_of(mesh.nodes[n]), WithinAbs(0.40, ring ? 1e-5 : 1e-14));
      CHECK(mesh.node_sets.count("arc_min") == (ring ? 0u : 1u));
    }
}

TEST_CASE("A roller has the volume of its ring") {
  scene::MeshSource source = roller();
  source.roller.ring = true;
  const double exact = M_PI * (0.46 * 0.46 - 0.4 * 0.4) * 0.08;
  CHECK_THAT(mesh_quality(build_mesh(source), 1).volume, WithinRel(exact, 1e-10));
}

TEST_CASE("A roller's zone lies about the lowest point, positive arcs towards +x, its tread turned outwards") {
  scene::MeshSource source = roller();
  source.roller.zone_start = -0.005;
  source.roller.zone_end = 0.03;
  const Mesh mesh = build_mesh(source);
  int found = 0;
  for (const Face& face : mesh.surfaces.at("tread")) {
    const auto c = mesh.face_nodes(face);
    const Vec3 &a = mesh.nodes[c[0]], &b = mesh.nodes[c[1]], &d = mesh.nodes[c[3]];
    CHECK((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) < 0);
    const auto arc = [&](int n) { return 0.46 * std::atan2(mesh.nodes[n][0], -mesh.nodes[n][2]); };
    const double first = std::min({arc(c[0]), arc(c[1]), arc(c[2])}),
                 last = std::max({arc(c[0]), arc(c[1]), arc(c[2])});
    double side = 0;
    for (int n : c) side = std::max(side, std::fabs(mesh.nodes[n][1]));
    if (first < -0.005 - 1e-9 || last > 0.03 + 1e-9 || side > 0.0099) continue;
    ++found;
    CHECK_THAT(last - first, WithinAbs(0.001, 1e-12));
  }
  CHECK(found == 35 * 18);
}

TEST_CASE("Parameters of a roller that do not fit are named with what is allowed") {
  const auto complaint = [](auto change) -> std::string {
    scene::MeshSource source = roller();
    change(source.roller);
    return complaint_of(source);
  };
  CHECK(complaint([](auto&) {}).empty());
  CHECK_THAT(complaint([](auto& r) { r.bore_radius = 0.5; }),
             ContainsSubstring("[meshes.roller] (line 6): bore_radius = 0.5; allowed: above 0 and below radius"));
  CHECK_THAT(complaint([](auto& r) { r.arc_end = 3; }), ContainsSubstring("a whole roller is ring = true"));
  CHECK_THAT(complaint([](auto& r) { r.crown_radius = 0.02; }), ContainsSubstring("crown_radius"));
  CHECK_THAT(complaint([](auto& r) { r.zone_start = 0.07, r.zone_end = 0.08; }),
             ContainsSubstring("zone that meets the sector"));
}
