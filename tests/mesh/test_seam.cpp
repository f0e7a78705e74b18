#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <set>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/face_table.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/quality.hpp"
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
  return build_mesh(source);
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
    const Vec3 area = area_vector(mesh, face);
    sum += std::hypot(area[0], area[1], area[2]);
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

TEST_CASE("what a seam became is said: nodes, faces, length and depth beside those asked for") {
  Mesh mesh = box({24, 8, 4});
  auto crack = seam({0.061, 0.02, 0.02}, 0.023, 0.012, 0);
  crack.mesh = "block";
  crack.line = 4;
  const OpenedSeam opened = open_seam(crack, "here", mesh);
  CHECK(opened.nodes == 6);
  CHECK(opened.faces == 8);
  CHECK_THAT(opened.length, WithinRel(0.02, 1e-12));
  CHECK_THAT(opened.depth, WithinRel(0.01, 1e-12));
  CHECK(describe(crack, opened) ==
        "[seams.crack] (line 4) opens 6 nodes of mesh block between 8 pairs of element faces: 0.02 m long (0.023 m "
        "asked for), 0.01 m deep (0.012 m asked for)");
}

TEST_CASE("two elements long and one deep is the least that opens, one node") {
  Mesh mesh = box({24, 8, 4});
  const OpenedSeam opened = open_seam(seam({0.06, 0.02, 0.02}, 0.01, 0.005, 0), "here", mesh);
  CHECK(opened.nodes == 1);
  CHECK(opened.faces == 2);
}

TEST_CASE("a seam's depth is measured from the surface, wherever near it its place lies") {
  for (double above : {-0.004, 0.0, 0.004}) {
    Mesh mesh = box({24, 8, 4});
    const OpenedSeam opened = open_seam(seam({0.06, 0.02, 0.02 + above}, 0.02, 0.01, 0), "here", mesh);
    CHECK(opened.nodes == 6);
    CHECK_THAT(opened.depth, WithinRel(0.01, 1e-12));
  }
}

TEST_CASE("a seam as deep as the body that is not as wide leaves it in one piece") {
  Mesh mesh = box({24, 8, 4});
  const OpenedSeam opened = open_seam(seam({0.06, 0.02, 0.02}, 0.02, 1, 0), "here", mesh);
  CHECK_THAT(opened.depth, WithinRel(0.02, 1e-12));
  CHECK(connected_bodies(mesh) == 1);
}

TEST_CASE("seams that cannot be are refused with the reason") {
  const auto complaint = [](const scene::Seam& one) -> std::string {
    Mesh mesh = box({24, 8, 4});
    try {
      open_seam(one, "case.toml:3: [seams.crack]", mesh);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(complaint(seam({0.06, 0.02, 0.02}, 0.02, 0.001, 0)),
             ContainsSubstring("case.toml:3: [seams.crack]: no layer of element faces across x"));
  CHECK_THAT(complaint(seam({0.06, 0.02, 0.02}, 0.02, 0.001, 0)),
             ContainsSubstring("at least two elements (0.01 m) long and one (0.005 m) deep"));
  CHECK_THAT(complaint(seam({0.005, 0.02, 0.02}, 0.02, 0.01, 1)),
             ContainsSubstring("place the seam farther from the end"));
  CHECK_THAT(complaint(seam({0.06, 0.0225, 0.02}, 0.006, 0.01, 0)),
             ContainsSubstring("[seams.crack]: opens no node: of its 2 element faces all nodes lie on its front"));
  CHECK_THAT(complaint(seam({0.06, 0.02, 0.014}, 0.02, 0.002, 0)),
             ContainsSubstring("[seams.crack] place: [0.06, 0.02, 0.014] is 0.006 m below the mesh's upper surface, "
                               "from which the depth is measured; the nearest place on it is [0.06, 0.02, 0.02]"));
  CHECK_THAT(complaint(seam({0.06, 0.02, 0.026}, 0.02, 0.01, 0)),
             ContainsSubstring("is 0.006 m above the mesh's upper surface"));
  CHECK_THAT(complaint(seam({0.06, 0.05, 0.01}, 0.04, 0.01, 0)),
             ContainsSubstring("lies beside the mesh: its upper surface is nowhere over or under it; the nearest place "
                               "on it is [0.06, 0.04, 0.02]"));
  CHECK_THAT(complaint(seam({0.06, 0.02, 0.02}, 1, 1, 0)),
             ContainsSubstring("cuts the body in two: it became 0.04 m long and 0.02 m deep"));
  Mesh mesh = box({24, 8, 4});
  open_seam(seam({0.06, 0.02, 0.02}, 0.02, 0.01, 0), "here", mesh);
  CHECK_THROWS_AS(open_seam(seam({0.06, 0.02, 0.02}, 0.02, 0.01, 0), "here", mesh), InputError);
}

TEST_CASE("a seam with a width has its faces that far apart, square to its plane, and its front in common") {
  for (double angle : {0.0, 0.5, -0.4}) {
    scene::Seam one = seam({0.06, 0.02, 0.02}, 0.02, 0.01, angle);
    Mesh closed = box({48, 16, 8}), open = closed;
    open_seam(one, "case.toml:1: [seams.crack]", closed);
    one.width = 1e-4;
    open_seam(one, "case.toml:1: [seams.crack]", open);
    REQUIRE(open.nodes.size() == closed.nodes.size());
    CHECK(shared_nodes(open) == shared_nodes(closed));
    const auto before = nodes_of(open, "crack_before"), behind = nodes_of(open, "crack_behind");
    for (const auto& [side, way] : {std::pair{before, -0.5}, std::pair{behind, 0.5}})
      for (int n : side) {
        if (before.count(n) != 0 && behind.count(n) != 0) continue;
        const Vec3& x = open.nodes[n];
        const double off = (x[0] - one.place[0]) * std::cos(angle) - (one.place[2] - x[2]) * std::sin(angle);
        CHECK_THAT(off, WithinAbs(way * one.width, 1e-9));
      }
    CHECK(mesh_quality(open, 1).inverted == 0);
    one.width = 0.003;
    Mesh coarse = box({48, 16, 8});
    CHECK_THROWS_WITH(open_seam(one, "case.toml:1: [seams.crack]", coarse),
                      ContainsSubstring("[seams.crack] width = 0.003 m is too wide for the elements beside it"));
  }
}
