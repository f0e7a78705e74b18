#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/curve.hpp"
#include "mesh/quality.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource block(double along, double across) {
  scene::MeshSource source;
  source.name = "block";
  source.line = 4;
  source.type = scene::MeshType::crowned_block;
  source.crowned_block.radius_along = along;
  source.crowned_block.radius_across = across;
  return source;
}

/// Mean of crown_fall over the block's plan, by Gauss' rule of two points in many cells.
double mean_fall(const scene::CrownedBlockMesh& b) {
  const int cells = 200;
  double sum = 0;
  for (int i = 0; i < 2 * cells; ++i)
    for (int j = 0; j < 2 * cells; ++j) {
      const auto at = [&](int k) { return (k / 2 + 0.5 + (k % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.0)) / cells; };
      sum +=
          crown_fall(b.radius_along, b.radius_across, b.origin[0] + b.size[0] * at(i), b.origin[1] + b.size[1] * at(j));
    }
  return sum / (4.0 * cells * cells);
}

void check_sound(const Mesh& mesh) {
  const MeshQuality quality = mesh_quality(mesh, 1);
  CHECK(quality.inverted == 0);
  CHECK(quality.jacobian_ratio.value > 0.5);
  const Topology found = topology(mesh);
  check_solid(found, 2);
  CHECK(found.largest_size_ratio < 1.3);
}

}  // namespace

TEST_CASE("A crowned block's top is a sphere, a cylinder, a turned arc or a plane, exact at every node") {
  const double h = 0;  // the height of the crest
  const std::pair<double, double> shapes[] = {{0, 0}, {0.46, 0}, {0, 0.3}, {0.46, 0.46}, {0.46, 0.3}};
  for (const auto& [along, across] : shapes) {
    CAPTURE(along, across);
    const Mesh mesh = build_mesh(block(along, across));
    check_sound(mesh);
    double highest = -1;
    for (int n : mesh.node_sets.at("top")) {
      const auto [x, y, z] = mesh.nodes[n];
      highest = std::max(highest, z);
      if (along == 0 && across == 0)
        CHECK_THAT(z, WithinAbs(h, 1e-15));
      else if (across == 0)
        CHECK_THAT(std::hypot(x, z + along), WithinAbs(along, 1e-14));
      else if (along == 0)
        CHECK_THAT(std::hypot(y, z + across), WithinAbs(across, 1e-14));
      else
        CHECK_THAT(std::hypot(std::hypot(x, z + along) - (along - across), y), WithinAbs(across, 1e-14));  // a torus
    }
    CHECK_THAT(highest, WithinAbs(h, 1e-15));
    for (int n : mesh.node_sets.at("bottom")) CHECK(mesh.nodes[n][2] == -0.06);
  }
}

TEST_CASE("A crowned block has the volume under its crown") {
  const std::pair<double, double> shapes[] = {{0, 0}, {0, 0.3}, {0.2, 0.3}};
  for (const auto& [along, across] : shapes) {
    scene::MeshSource source = block(along, across);
    source.crowned_block.coarse_size = 0.002;
    const auto& b = source.crowned_block;
    const double exact = b.size[0] * b.size[1] * (b.size[2] - mean_fall(b));
    // Chords of 2 mm lie h^2 / 12 (1 / R_x + 1 / R_y) under the arcs, 4.6e-5 of the height.
    CHECK_THAT(mesh_quality(build_mesh(source), 1).volume, WithinRel(exact, 5e-5));
  }
}

TEST_CASE("The zone of a crowned block has the size and the layers asked for, also on a quarter of it") {
  scene::MeshSource source = block(0, 0);
  auto& b = source.crowned_block;
  b.zone_size = 0.0013;
  b.layer_height = 0.0007;
  SECTION("whole") {}
  SECTION("quarter") {
    b.origin = {0, 0, -0.06};
    b.size = {0.04, 0.04, 0.06};
  }
  SECTION("one element wide") {
    b.origin[1] = 0;
    b.size[1] = 0.0013;
  }
  const Mesh mesh = build_mesh(source);
  check_sound(mesh);
  int found = 0;
  for (const Face& face : mesh.surfaces.at("top")) {
    const auto nodes = mesh.face_nodes(face);
    Vec3 low{1, 1, 1}, high{-1, -1, -1};
    for (int n : mesh.elements[face.element])
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], mesh.nodes[n][i]);
        high[i] = std::max(high[i], mesh.nodes[n][i]);
      }
    if (low[0] < -0.0099 || high[0] > 0.0099 || low[1] < -0.0099 || high[1] > 0.0099) continue;
    ++found;
    CHECK_THAT(high[0] - low[0], WithinAbs(0.0013, 1e-12));
    CHECK_THAT(high[1] - low[1], WithinAbs(0.0013, 1e-12));
    CHECK_THAT(high[2] - low[2], WithinRel(0.0007, 0.01));
    CHECK(nodes.size() == 4);
  }
  CHECK(found >= 7);
}

TEST_CASE("Parameters of a crowned block that do not fit are named with what is allowed") {
  const auto complaint = [](auto change) -> std::string {
    scene::MeshSource source = block(0, 0.3);
    change(source.crowned_block);
    return complaint_of(source);
  };
  CHECK(complaint([](auto&) {}).empty());
  CHECK_THAT(complaint([](auto& b) { b.radius_across = 0.03; }),
             ContainsSubstring("[meshes.block] (line 4): radius_across = 0.03; allowed: 0 (straight) or more than"));
  CHECK_THAT(complaint([](auto& b) { b.zone_end = -0.02; }), ContainsSubstring("more than zone_start"));
  CHECK_THAT(complaint([](auto& b) { b.zone_start = 0.05, b.zone_end = 0.06; }),
             ContainsSubstring("zone that meets the block"));
  CHECK_THAT(complaint([](auto& b) { b.size[2] = 0.002, b.origin[2] = 0; }),
             ContainsSubstring("twice what the crown falls"));
}
