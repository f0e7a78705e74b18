#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <set>

#include "case/error.hpp"
#include "mesh/box.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/quality.hpp"
#include "mesh/rail.hpp"
#include "mesh/seam.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Mesh box(std::array<int, 3> divisions) {
  scene::MeshSource source;
  source.box.size = {0.12, 0.04, 0.02};
  source.box.divisions = divisions;
  return box_mesh(source);
}

scene::Seam seam(Vec3 place, double length, double depth, double angle) {
  scene::Seam one;
  one.name = "crack";
  one.place = place;
  one.length = length;
  one.depth = depth;
  one.angle = angle;
  return one;
}

double area_of(const Mesh& mesh, const std::vector<Face>& faces) {
  double sum = 0;
  for (const Face& face : faces) {
    const auto n = mesh.face_nodes(face);
    Vec3 p, q;
    for (int i = 0; i < 3; ++i) p[i] = mesh.nodes[n[2]][i] - mesh.nodes[n[0]][i], q[i] = mesh.nodes[n[3]][i] - mesh.nodes[n[1]][i];
    sum += 0.5 * std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
  }
  return sum;
}

std::set<int> nodes_of(const Mesh& mesh, const std::string& surface) {
  std::set<int> nodes;
  for (const Face& face : mesh.surfaces.at(surface))
    for (int n : mesh.face_nodes(face)) nodes.insert(n);
  return nodes;
}

/// Both faces of the seam on its plane, face to face, with the front alone in common.
void check_seam(const Mesh& mesh, const scene::Seam& seam, double area, double slack) {
  const auto &before = mesh.surfaces.at("crack_before"), &behind = mesh.surfaces.at("crack_behind");
  REQUIRE(before.size() == behind.size());
  CHECK_THAT(area_of(mesh, before), WithinRel(area, slack));
  CHECK_THAT(area_of(mesh, behind), WithinRel(area_of(mesh, before), 1e-12));
  for (const char* name : {"crack_before", "crack_behind"})
    for (int n : nodes_of(mesh, name)) {
      const Vec3& x = mesh.nodes[n];
      CHECK_THAT(x[0] - seam.place[0] - std::tan(seam.angle) * (seam.place[2] - x[2]), WithinAbs(0, 1e-6));
    }
  for (const Face& face : before) {  // looks along x
    const auto n = mesh.face_nodes(face);
    const Vec3 &a = mesh.nodes[n[0]], &b = mesh.nodes[n[1]], &d = mesh.nodes[n[3]];
    CHECK((b[1] - a[1]) * (d[2] - a[2]) - (b[2] - a[2]) * (d[1] - a[1]) > 0);
  }
  const MeshQuality quality = mesh_quality(mesh, 1);
  CHECK(quality.inverted == 0);
}

std::size_t shared_nodes(const Mesh& mesh) {
  const auto before = nodes_of(mesh, "crack_before"), behind = nodes_of(mesh, "crack_behind");
  std::size_t shared = 0;
  for (int n : before) shared += behind.count(n);
  return shared;
}

}  // namespace

TEST_CASE("a seam in a box: half a penny's box of faces, open at the top, with its front in common") {
  Mesh mesh = box({24, 8, 4});
  const std::size_t nodes = mesh.nodes.size();
  const double volume = mesh_quality(mesh, 1).volume;
  const auto crack = seam({0.061, 0.02, 0.02}, 0.02, 0.01, 0);
  open_seam(crack, "here", mesh);
  check_seam(mesh, crack, 0.02 * 0.01, 1e-9);
  // Four faces wide, two deep: of 15 nodes the outer ones of both sides and of the bottom stay whole.
  CHECK(shared_nodes(mesh) == 9);
  CHECK(mesh.nodes.size() == nodes + 6);
  CHECK_THAT(mesh_quality(mesh, 1).volume, WithinRel(volume, 1e-12));
  // The mouth's nodes lie on top on both sides.
  std::size_t on_top = 0;
  for (int n : mesh.node_sets.at("z_max")) on_top += mesh.nodes[n][2] > 0.02 - 1e-12;
  CHECK(on_top == 25 * 9 + 3);
  const Topology found = topology(mesh);
  CHECK(found.open_edges == 0);
  CHECK(found.components == 1);
  CHECK(found.euler == 2);
}

TEST_CASE("an inclined seam bends the layers onto its plane, and one through the whole width has no ends") {
  Mesh mesh = box({40, 8, 8});
  const double volume = mesh_quality(mesh, 1).volume;
  const auto crack = seam({0.05, 0.02, 0.02}, 1, 0.01, 0.5);
  open_seam(crack, "here", mesh);
  check_seam(mesh, crack, 0.04 * 0.01 * std::cos(0.5) / std::cos(0.5), 0.13);
  CHECK(shared_nodes(mesh) == 9);
  CHECK_THAT(mesh_quality(mesh, 1).volume, WithinRel(volume, 1e-12));
  for (int n : mesh.node_sets.at("x_max")) CHECK(mesh.nodes[n][0] == 0.12);
}

TEST_CASE("a seam in a rail's head goes down through its coarser layers") {
  scene::MeshSource source;
  source.name = "rail";
  source.rail.end = 0.42;
  source.rail.inclination = 0;
  Mesh mesh = rail_mesh(source);
  const double volume = mesh_quality(mesh, 1).volume;
  const auto crack = seam({0.051, -0.003, 0.159}, 0.02, 0.014, 0.4);
  open_seam(crack, "here", mesh);
  check_seam(mesh, crack, 0.02 * 0.014, 0.3);
  CHECK_THAT(mesh_quality(mesh, 1).volume, WithinRel(volume, 1e-9));
  CHECK(mesh_quality(mesh, 1).step.value > 0.5 * source.rail.zone_size);
  double deepest = 1;
  for (int n : nodes_of(mesh, "crack_before")) deepest = std::min(deepest, mesh.nodes[n][2]);
  CHECK_THAT((0.159 - deepest) / std::cos(0.4), WithinAbs(0.014, 0.004));
  CHECK(topology(mesh).open_edges == 0);
}

TEST_CASE("seams that cannot be are told why") {
  const auto complaint = [](const scene::Seam& one) -> std::string {
    Mesh mesh = box({24, 8, 4});
    try {
      open_seam(one, "case.toml:3: [seams.crack]", mesh);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(complaint(seam({0.06, 0.02, 0.02}, 0.02, 0.001, 0)), ContainsSubstring("case.toml:3: [seams.crack]: no layer of element faces across x"));
  CHECK_THAT(complaint(seam({0.005, 0.02, 0.02}, 0.02, 0.01, 1)), ContainsSubstring("place the seam farther from the end"));
  Mesh mesh = box({24, 8, 4});
  open_seam(seam({0.06, 0.02, 0.02}, 0.02, 0.01, 0), "here", mesh);
  CHECK_THROWS_AS(open_seam(seam({0.06, 0.02, 0.02}, 0.02, 0.01, 0), "here", mesh), InputError);
}
