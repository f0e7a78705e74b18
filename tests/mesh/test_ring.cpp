#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/quality.hpp"
#include "round_bodies.hpp"
#include "tests/case/temporary_case.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource ring() {
  scene::MeshSource source;
  source.name = "tyre";
  source.line = 5;
  source.type = scene::MeshType::ring;
  return source;
}

scene::MeshSource ring_of(int round, int wall, int width) {
  scene::MeshSource source = ring();
  source.ring.round_divisions = round;
  source.ring.wall_divisions = wall;
  source.ring.width_divisions = width;
  return source;
}

}  // namespace

TEST_CASE("A ring is a sound solid whatever its divisions, closed where its last cells meet the first") {
  for (const auto& [round, wall, width] :
       {std::array<int, 3>{8, 1, 1}, {9, 2, 1}, {36, 1, 4}, {90, 2, 3}, {120, 5, 2}}) {
    CAPTURE(round, wall, width);
    const scene::MeshSource source = ring_of(round, wall, width);
    const Mesh mesh = build_mesh(source);
    CHECK(mesh.elements.size() == static_cast<std::size_t>(round * wall * width));
    CHECK(expected_elements(source) == static_cast<double>(mesh.elements.size()));
    // No node is doubled at the seam.
    CHECK(mesh.nodes.size() == static_cast<std::size_t>(round * (wall + 1) * (width + 1)));
    const MeshQuality quality = mesh_quality(mesh, 1);
    CHECK(quality.inverted == 0);
    // The least Jacobian of a cell over its greatest is the ratio of the cell's radii.
    CHECK(quality.jacobian_ratio.value > 0.40 / 0.46 - 1e-12);
    const Topology found = topology(mesh);
    check_solid(found, 0);
  }
}

TEST_CASE("A ring has the volume of the prism between its polygons, and comes near the round one's") {
  const scene::MeshSource source = ring_of(64, 3, 2);
  const double round = M_PI * (0.46 * 0.46 - 0.4 * 0.4) * 0.08, angle = 2 * M_PI / 64;
  const double volume = mesh_quality(build_mesh(source), 1).volume;
  CHECK_THAT(volume, WithinRel(round * std::sin(angle) / angle, 1e-12));
  CHECK_THAT(volume, WithinRel(round, 2e-3));  // sin a = a (1 - a^2 / 6)
}

TEST_CASE("A ring's sets are its sides, exact at every node") {
  const Mesh mesh = build_mesh(ring_of(36, 2, 3));
  CHECK(mesh.node_sets.size() == 4);
  CHECK(mesh.surfaces.size() == 4);
  CHECK(mesh.node_sets.at("outer").size() == 36u * 4u);
  for (int n : mesh.node_sets.at("outer")) CHECK_THAT(radius_of(mesh.nodes[n]), WithinAbs(0.46, 1e-15));
  CHECK(mesh.node_sets.at("inner").size() == 36u * 4u);
  for (int n : mesh.node_sets.at("inner")) CHECK_THAT(radius_of(mesh.nodes[n]), WithinAbs(0.4, 1e-15));
  CHECK(mesh.node_sets.at("y_min").size() == 36u * 3u);
  for (int n : mesh.node_sets.at("y_min")) CHECK(mesh.nodes[n][1] == -0.04);
  CHECK(mesh.node_sets.at("y_max").size() == 36u * 3u);
  for (int n : mesh.node_sets.at("y_max")) CHECK(mesh.nodes[n][1] == 0.04);
}

TEST_CASE("A ring's faces look outwards, and begin at the lowest point towards +x") {
  const Mesh mesh = build_mesh(ring_of(64, 2, 3));
  CHECK_THAT(mesh.nodes[0][0], WithinAbs(0, 1e-15));
  CHECK(mesh.nodes[0][2] == -0.46);
  CHECK(mesh.nodes[1][0] > 0);
  /// Area of a surface along y, or away from the axis, m2.
  const auto area = [&](const char* name, bool along) {
    double sum = 0;
    for (const Face& face : mesh.surfaces.at(name)) {
      Vec3 middle{0, 0, 0};
      for (int n : mesh.face_nodes(face))
        for (int i = 0; i < 3; ++i) middle[i] += mesh.nodes[n][i] / 4;
      const Vec3 normal = area_vector(mesh, face);
      sum += along ? normal[1] : (normal[0] * middle[0] + normal[2] * middle[2]) / radius_of(middle);
    }
    return sum;
  };
  const double angle = 2 * M_PI / 64, chord = 2 * std::sin(angle / 2);
  CHECK_THAT(area("outer", false), WithinRel(64 * chord * 0.46 * 0.08, 1e-12));
  CHECK_THAT(area("inner", false), WithinRel(-64 * chord * 0.4 * 0.08, 1e-12));
  const double side = 32 * std::sin(angle) * (0.46 * 0.46 - 0.4 * 0.4);
  CHECK_THAT(area("y_max", true), WithinRel(side, 1e-12));
  CHECK_THAT(area("y_min", true), WithinRel(-side, 1e-12));
}

TEST_CASE("A ring is made from the keys of a case") {
  const test::TemporaryCase file(
      test::small_case +
      "[meshes.tyre]\ntype = \"ring\"\ninner_radius = 0.1\nouter_radius = 0.2\nwidth = 0.02\n"
      "round_divisions = 40\nwall_divisions = 5\nwidth_divisions = 1\n");
  const scene::Scene scene = read_case(file.path());
  REQUIRE(scene.meshes.size() == 2);
  CHECK(scene.meshes[1].type == scene::MeshType::ring);
  const Mesh mesh = build_mesh(scene.meshes[1]);
  CHECK(mesh.elements.size() == 200);
  const double angle = 2 * M_PI / 40;
  CHECK_THAT(mesh_quality(mesh, 1).volume, WithinRel(20 * std::sin(angle) * (0.04 - 0.01) * 0.02, 1e-12));
}

TEST_CASE("A ring has no fine zone") { CHECK(fine_element_size(ring()) == 0); }

TEST_CASE("Parameters of a ring that do not fit are named with what is allowed") {
  const auto complaint = [](auto change) -> std::string {
    scene::MeshSource source = ring();
    change(source.ring);
    return complaint_of(source);
  };
  CHECK(complaint([](auto&) {}).empty());
  CHECK_THAT(complaint([](auto& r) { r.inner_radius = 0.5; }),
             ContainsSubstring("[meshes.tyre] (line 5): inner_radius = 0.5; allowed: above 0 and below outer_radius"));
  CHECK_THAT(complaint([](auto& r) { r.width = 0; }), ContainsSubstring("width = 0; allowed: above 0"));
  CHECK_THAT(complaint([](auto& r) { r.round_divisions = 4; }),
             ContainsSubstring("round_divisions = 4; allowed: at least 8"));
}
