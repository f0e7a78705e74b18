#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/generators/wheel.hpp"
#include "mesh/quality.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

namespace {

/// Of a surface's faces: where it begins and ends along its way, and the longest face there.
struct Along {
  double first = 1e9, last = -1e9, longest = 0;
};

template <class Coordinate>
Along along(const Mesh& mesh, const char* surface, const Coordinate& coordinate) {
  Along found;
  for (const Face& face : mesh.surfaces.at(surface)) {
    double low = 1e9, high = -1e9;
    for (int n : mesh.face_nodes(face)) {
      low = std::min(low, coordinate(mesh.nodes[n]));
      high = std::max(high, coordinate(mesh.nodes[n]));
    }
    if (high - low > 1) continue;  // over the arc's own end
    found = {std::min(found.first, low), std::max(found.last, high), std::max(found.longest, high - low)};
  }
  return found;
}

void check_sound(const Mesh& mesh) {
  CHECK(mesh_quality(mesh, 1).inverted == 0);
  const Topology found = topology(mesh);
  CHECK(found.crowded_faces == 0);
  CHECK(found.open_edges == 0);
  CHECK(found.components == 1);
}

}  // namespace

TEST_CASE("a rail's head is fine along the path to its zone, and no farther") {
  scene::MeshSource source;
  source.type = scene::MeshType::rail;
  source.name = "rail";
  source.line = 5;
  source.rail.start = -2;
  source.rail.end = 1;
  source.rail.zone_start = 0;
  source.rail.zone_end = 0.1;
  source.rail.path_start = -0.8;
  source.rail.path_end = 0.2;
  source.rail.path_size = 0.005;
  const Mesh mesh = rail_mesh(source);
  check_sound(mesh);
  const auto x = [](const Vec3& p) { return p[0]; };
  const Along head = along(mesh, "head", x), whole = along(mesh, "running_surface", x);
  CHECK(head.first < -0.8 + 1e-9);
  CHECK(head.first > -0.83);
  CHECK(head.last > 0.2 - 1e-9);
  CHECK(head.last < 0.23);
  CHECK(head.longest < 1.6 * 0.005);  // its margin begins to grow again
  CHECK(whole.longest > 0.02);
  CHECK(mesh.element_sets.at("zone").size() == 15u * 3u * 50u);

  source.rail.path_start = 0.05;
  CHECK_THAT(complaint_of(source),
             ContainsSubstring("[meshes.rail] (line 5): path_start = 0.05; allowed: -2 m to zone_start = 0 m"));
  source.rail.path_start = -0.8;
  source.rail.path_size = 0.05;
  CHECK_THAT(complaint_of(source), ContainsSubstring("path_size = 0.05; allowed: zone_size = 0.002 to coarse_size"));
}

TEST_CASE("a path that ends with the rail leaves no sliver there") {
  scene::MeshSource source;
  source.rail.start = -0.5;
  source.rail.end = 0.0971;
  source.rail.zone_start = 0;
  source.rail.zone_end = 0.05;
  source.rail.path_start = -0.499;
  source.rail.path_size = 0.005;
  const Mesh mesh = rail_mesh(source);
  check_sound(mesh);
  CHECK(mesh_quality(mesh, 1).step.value > 0.4 * source.rail.zone_size);
  CHECK_THAT(along(mesh, "head", [](const Vec3& p) { return p[0]; }).first, WithinAbs(-0.5, 1e-12));
}

TEST_CASE("a wheel's tread is fine along the arc that it rolls towards its zone") {
  scene::MeshSource source;
  source.type = scene::MeshType::wheel;
  source.name = "wheel";
  source.line = 9;
  source.wheel.zone_start = 0.9;
  source.wheel.zone_length = 0.1;
  source.wheel.path_start = -0.03;
  source.wheel.path_length = 1.1;
  source.wheel.path_size = 0.006;
  const Mesh mesh = wheel_mesh(source);
  check_sound(mesh);
  const auto arc = [](const Vec3& p) { return 0.46 * std::atan2(p[0], -p[2]); };
  const Along tread = along(mesh, "tread", arc), whole = along(mesh, "running_surface", arc);
  CHECK(tread.first < -0.03 + 1e-6);
  CHECK(tread.first > -0.07);
  CHECK(tread.last > 1.07 - 1e-6);
  CHECK(tread.last < 1.11);
  CHECK(tread.longest < 1.6 * 0.006);
  CHECK(whole.longest > 0.015);

  source.wheel.path_length = 0.5;
  CHECK_THAT(complaint_of(source),
             ContainsSubstring("[meshes.wheel] (line 9): the path's end = 0.47; allowed: the zone's end = 1"));
  source.wheel.path_start = -1.5;
  source.wheel.path_length = 2.6;
  CHECK_THAT(complaint_of(source), ContainsSubstring("path_start = -1.5; allowed: -0.49"));
}
