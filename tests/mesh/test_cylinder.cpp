#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/quality.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource cylinder() {
  scene::MeshSource source;
  source.name = "bar";
  source.line = 4;
  source.type = scene::MeshType::cylinder;
  return source;
}

}  // namespace

TEST_CASE("A cylinder is a sound solid whatever its divisions, exact at every node of its skin") {
  for (const auto& [core, ring] : {std::array<int, 2>{1, 1}, {2, 1}, {5, 3}, {6, 3}, {12, 8}}) {
    CAPTURE(core, ring);
    scene::MeshSource source = cylinder();
    source.cylinder.core_divisions = core;
    source.cylinder.ring_divisions = ring;
    const Mesh mesh = build_mesh(source);
    CHECK(mesh.elements.size() == static_cast<std::size_t>(core * (core + 4 * ring) * 20));
    const MeshQuality quality = mesh_quality(mesh, 1);
    CHECK(quality.inverted == 0);
    // A core of two by two is as coarse as can be: its ring bends by 45 degrees within a cell.
    CHECK(quality.jacobian_ratio.value > (core > 2 ? 0.45 : 0.3));
    const Topology found = topology(mesh);
    check_solid(found, 2);
    CHECK(mesh.node_sets.at("skin").size() == static_cast<std::size_t>(4 * core * 21));
    for (int n : mesh.node_sets.at("skin"))
      CHECK_THAT(std::hypot(mesh.nodes[n][0], mesh.nodes[n][1]), WithinAbs(0.01, 1e-16));
    for (int n : mesh.node_sets.at("z_min")) CHECK(mesh.nodes[n][2] == 0);
    for (int n : mesh.node_sets.at("z_max")) CHECK(mesh.nodes[n][2] == 0.05);
  }
}

TEST_CASE("A cylinder has the volume of the prism on its skin's polygon, and comes near the round one's") {
  scene::MeshSource source = cylinder();
  source.cylinder.core_divisions = 16;
  source.cylinder.ring_divisions = 8;
  const double sides = 64, polygon = 0.5 * sides * std::sin(2 * M_PI / sides) * 1e-4;
  const double volume = mesh_quality(build_mesh(source), 1).volume;
  CHECK_THAT(volume, WithinRel(polygon * 0.05, 1e-12));
  CHECK_THAT(volume, WithinRel(M_PI * 1e-4 * 0.05, 2e-3));
}

TEST_CASE("A cylinder's faces look outwards: skin away from the axis, ends along it") {
  const Mesh mesh = build_mesh(cylinder());
  const auto area = [&](const char* name, int axis) {
    double sum = 0;
    for (const Face& face : mesh.surfaces.at(name)) {
      Vec3 middle{};
      for (int n : mesh.face_nodes(face))
        for (int i = 0; i < 3; ++i) middle[i] += 0.25 * mesh.nodes[n][i];
      const Vec3 normal = area_vector(mesh, face);
      sum += axis == 2 ? normal[2] : (normal[0] * middle[0] + normal[1] * middle[1]) / std::hypot(middle[0], middle[1]);
    }
    return sum;
  };
  CHECK_THAT(area("z_max", 2), WithinRel(M_PI * 1e-4, 0.02));
  CHECK_THAT(area("z_min", 2), WithinRel(-M_PI * 1e-4, 0.02));
  CHECK_THAT(area("skin", 0), WithinRel(2 * M_PI * 0.01 * 0.05, 0.02));
}

TEST_CASE("A cylinder's layers grow from the first to end_ratio times it") {
  scene::MeshSource source = cylinder();
  source.cylinder.end_ratio = 3;
  const Mesh mesh = build_mesh(source);
  const auto height = [&](std::size_t e) {
    return mesh.nodes[mesh.elements[e][4]][2] - mesh.nodes[mesh.elements[e][0]][2];
  };
  CHECK_THAT(height(mesh.elements.size() - 1) / height(0), WithinRel(3.0, 1e-10));
}

TEST_CASE("Parameters of a cylinder that do not fit are named with what is allowed") {
  const auto complaint = [](auto change) -> std::string {
    scene::MeshSource source = cylinder();
    change(source.cylinder);
    return complaint_of(source);
  };
  CHECK(complaint([](auto&) {}).empty());
  CHECK_THAT(complaint([](auto& c) { c.core_share = 0.95; }),
             ContainsSubstring("[meshes.bar] (line 4): core_share = 0.95; allowed: 0.2 to 0.8"));
  CHECK_THAT(complaint([](auto& c) { c.ring_divisions = 0; }),
             ContainsSubstring("ring_divisions = 0; allowed: at least 1"));
}
