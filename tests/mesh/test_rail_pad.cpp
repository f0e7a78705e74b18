#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "case/solid_pad.hpp"
#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/quality.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource pad_source() {
  scene::MeshSource source;
  source.name = "pad";
  source.line = 7;
  source.type = scene::MeshType::rail_pad;
  source.rail_pad.rail = "rail";
  return source;
}

scene::MeshSource rail_of(const scene::MeshSource& pad) {
  scene::MeshSource source;
  source.name = pad.rail_pad.rail;
  source.type = scene::MeshType::rail;
  source.rail = pad.rail_pad.rail_mesh;
  return source;
}

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double nearest(const Mesh& mesh, const std::vector<int>& nodes, const Vec3& x) {
  double least = 1;
  for (int n : nodes) least = std::min(least, distance(mesh.nodes[n], x));
  return least;
}

}  // namespace

TEST_CASE("a rail pad has the foot's lines, is as wide as the foot, and as thick everywhere") {
  for (const char* section : {"54E1", "60E1"})
    for (double inclination : {0.025, -0.025})
      for (double zone : {0.002, 0.007}) {
        scene::MeshSource source = pad_source();
        auto& pad = source.rail_pad;
        pad.rail_mesh.section = section;
        pad.rail_mesh.inclination = inclination;
        pad.rail_mesh.zone_size = pad.rail_mesh.section_size = zone;
        if (zone > 0.005) pad.rail_mesh.zone_layers = 1;
        pad.start = 0.05;
        pad.end = 0.21;
        pad.layers = 3;
        INFO(section << ", inclination " << inclination << ", zone_size " << zone);
        const Mesh mesh = build_mesh(source), rail = rail_mesh(rail_of(source));
        double volume = 0, wide = 0;
        for (const auto& element : mesh.elements) {
          std::array<Vec3, 8> corners;
          for (int i = 0; i < 8; ++i) corners[i] = mesh.nodes[element[i]];
          volume += hexahedron_volume(corners);
        }
        const auto &top = mesh.node_sets.at("z_max"), &bottom = mesh.node_sets.at("z_min"),
                   &foot = rail.node_sets.at("foot");
        REQUIRE(top.size() == bottom.size());
        for (std::size_t k = 0; k < top.size(); ++k) {
          CHECK_THAT(distance(mesh.nodes[top[k]], mesh.nodes[bottom[k]]), WithinAbs(pad.thickness, 1e-12));
          wide = std::max(wide, distance(mesh.nodes[top[k]], mesh.nodes[top.front()]));
        }
        CHECK_THAT(volume, WithinRel(0.16 * case_file::foot_width(section) * pad.thickness, 1e-3));
        // Nodes of the foot off the pad's ends have one of the pad's on them; the pad's ends may lie between lines.
        int met = 0;
        for (int n : foot) {
          const Vec3& x = rail.nodes[n];
          if (x[0] < pad.start + 0.01 || x[0] > pad.end - 0.01) continue;
          CHECK(nearest(mesh, top, x) < 1e-12);
          ++met;
        }
        CHECK(met > 50);
        CHECK(mesh_quality(mesh, 1).inverted == 0);
      }
}

TEST_CASE("a rail pad keeps the foot's lines where they are parted") {
  scene::MeshSource source = pad_source();
  const Mesh plain = build_mesh(source);
  source.rail_pad.size = 0.005;
  const Mesh parted = build_mesh(source);
  const auto& nodes = parted.node_sets.at("z_max");
  for (int n : plain.node_sets.at("z_max")) CHECK(nearest(parted, nodes, plain.nodes[n]) < 1e-12);
  for (const auto& element : parted.elements) {
    CHECK(distance(parted.nodes[element[0]], parted.nodes[element[1]]) <= 0.005 * (1 + 1e-6));
    CHECK(distance(parted.nodes[element[1]], parted.nodes[element[2]]) <= 0.005 * (1 + 1e-6));
  }
}

TEST_CASE("a rail pad that is not under its rail is reported") {
  scene::MeshSource source = pad_source();
  source.rail_pad.start = -0.4;
  CHECK_THAT(complaint_of(source),
             ContainsSubstring("[meshes.pad] (line 7): start = -0.4; allowed: -0.3 m, the rail's start, or more"));
  source.rail_pad.start = 0.1;
  CHECK_THAT(complaint_of(source), ContainsSubstring("end = 0.08; allowed: more than start = 0.1 m"));
}
