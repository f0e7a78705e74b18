#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/quality.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource plate_source() {
  scene::MeshSource source;
  source.name = "plate";
  source.line = 7;
  source.type = scene::MeshType::fishplate;
  source.fishplate.rail = "rail";
  source.fishplate.gap_start = -0.003;
  source.fishplate.gap_end = 0.003;
  return source;
}

scene::MeshSource rail_of(const scene::MeshSource& plate) {
  scene::MeshSource source;
  source.name = plate.fishplate.rail;
  source.type = scene::MeshType::rail;
  source.rail = plate.fishplate.rail_mesh;
  return source;
}

/// How far in a plane of constant x a point lies from the nearest chord of the rail's fishing chamber.
double distance_to_rail(const Mesh& rail, const char* surface, const Vec3& p) {
  double nearest = 1;
  for (const Face& face : rail.surfaces.at(surface)) {
    const auto n = rail.face_nodes(face);
    double low = 1, high = -1;
    for (int k : n) low = std::min(low, rail.nodes[k][0]), high = std::max(high, rail.nodes[k][0]);
    if (p[0] < low - 1e-9 || p[0] > high + 1e-9) continue;
    for (int k = 0; k < 4; ++k) {
      const Vec3 &a = rail.nodes[n[k]], &b = rail.nodes[n[(k + 1) % 4]];
      const double dy = b[1] - a[1], dz = b[2] - a[2], squared = dy * dy + dz * dz;
      const double f = squared > 0 ? std::clamp(((p[1] - a[1]) * dy + (p[2] - a[2]) * dz) / squared, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, std::hypot(p[1] - a[1] - f * dy, p[2] - a[2] - f * dz));
    }
  }
  return nearest;
}

}  // namespace

TEST_CASE("a fishplate lies on the facets of its rail, on either side") {
  for (const char* section : {"54E1", "60E1"})
    for (auto side : {scene::RailSide::left, scene::RailSide::right}) {
      scene::MeshSource source = plate_source();
      source.fishplate.rail_mesh.section = section;
      source.fishplate.side = side;
      const bool left = side == scene::RailSide::left;
      INFO(section << (left ? " left" : " right"));
      const Mesh plate = build_mesh(source), rail = rail_mesh(rail_of(source));
      const MeshQuality quality = mesh_quality(plate, 1);
      CHECK(quality.inverted == 0);
      CHECK(quality.jacobian_ratio.value > 0.2);
      CHECK(quality.step.value > 0.4 * source.fishplate.rail_mesh.zone_size);
      const Topology found = topology(plate);
      CHECK(found.open_edges == 0);
      CHECK(found.euler == 2);
      double farthest = 0;
      for (const char* surface : {"fishing", "fishing_2"})
        for (const Face& face : plate.surfaces.at(surface))
          for (int n : plate.face_nodes(face)) {
            if (plate.nodes[n][0] > -0.1 && plate.nodes[n][0] < 0.1)
              farthest =
                  std::max(farthest, distance_to_rail(rail, left ? "fishing_left" : "fishing_right", plate.nodes[n]));
          }
      CHECK(farthest < 1e-9);
      for (const Face& face : plate.surfaces.at("fishing"))
        for (int n : plate.face_nodes(face)) CHECK(plate.nodes[n][0] < -0.003 + 1e-12);
      for (const Face& face : plate.surfaces.at("fishing_2"))
        for (int n : plate.face_nodes(face)) CHECK(plate.nodes[n][0] > 0.003 - 1e-12);
      // Outer side away from the rail, leaning as it does; a closed body has no area in all.
      const Vec3 outer = area_vector(plate, plate.surfaces.at("outer"));
      CHECK((left ? -1 : 1) * outer[1] > 0.6 * 0.07);
      CHECK((left ? -1 : 1) * outer[2] > 0);
      CHECK(area_vector(plate, plate.surfaces.at("upper"))[2] > 0);
      CHECK(area_vector(plate, plate.surfaces.at("lower"))[2] < 0);
      CHECK((left ? -1 : 1) * area_vector(plate, plate.surfaces.at("inner"))[1] < 0);
      for (int i = 0; i < 3; ++i) {
        double sum = 0;
        for (const char* surface : {"upper", "inner", "lower", "outer", "start_face", "end_face"})
          sum += area_vector(plate, plate.surfaces.at(surface))[i];
        CHECK_THAT(sum, WithinAbs(0, 1e-12));
      }
      const Vec3 start = area_vector(plate, plate.surfaces.at("start_face"));
      CHECK_THAT(quality.volume, WithinRel(-0.6 * start[0], 1e-9));
      CHECK(-start[0] > 0.0014);
      CHECK(-start[0] < 0.0026);
    }
}

TEST_CASE("a plate's web clearance, thickness and element size are those asked for") {
  scene::MeshSource source = plate_source();
  source.fishplate.rail_mesh.inclination = 0;
  source.fishplate.clearance = 0.001;
  source.fishplate.thickness = 0.018;
  source.fishplate.size = 0.01;
  source.fishplate.gap_start.reset();
  source.fishplate.gap_end.reset();
  const Mesh plate = build_mesh(source), rail = rail_mesh(rail_of(source));
  double web = 1, inner = 1, outer = 0;
  for (const Face& face : rail.surfaces.at("fishing_right"))
    for (int n : rail.face_nodes(face)) web = std::min(web, rail.nodes[n][1]);
  for (const Face& face : plate.surfaces.at("inner"))
    for (int n : plate.face_nodes(face)) inner = std::min(inner, -plate.nodes[n][1]);
  for (const Face& face : plate.surfaces.at("outer"))
    for (int n : plate.face_nodes(face)) outer = std::max(outer, -plate.nodes[n][1]);
  CHECK_THAT(inner - web, WithinAbs(0.001, 1e-5));  // the rail's two sides differ by as little
  CHECK_THAT(outer - inner, WithinAbs(0.018, 1e-9));
  CHECK(plate.surfaces.count("fishing_2") == 0);
  CHECK(plate.surfaces.at("fishing").size() ==
        plate.surfaces.at("upper").size() + plate.surfaces.at("inner").size() + plate.surfaces.at("lower").size());
  CHECK(plate.elements.size() % 60 == 0);
}

TEST_CASE("plates fit rails of other sizes") {
  const std::pair<const char*, void (*)(scene::RailMesh&)> rails[] = {
      {"1 mm", [](scene::RailMesh& r) { r.zone_size = 0.001; }},
      {"4 mm", [](scene::RailMesh& r) { r.zone_size = 0.004; }},
      {"7 mm", [](scene::RailMesh& r) { r.zone_size = 0.007, r.zone_layers = 1, r.section_size = 0.012; }},
      {"fine section", [](scene::RailMesh& r) { r.section_size = 0.004; }}};
  for (const auto& [name, change] : rails)
    for (auto side : {scene::RailSide::left, scene::RailSide::right}) {
      scene::MeshSource source = plate_source();
      change(source.fishplate.rail_mesh);
      source.fishplate.side = side;
      INFO(name);
      const MeshQuality quality = mesh_quality(build_mesh(source), 1);
      CHECK(quality.inverted == 0);
      CHECK(quality.jacobian_ratio.value > 0.15);
      CHECK(quality.step.value > 0.4 * source.fishplate.rail_mesh.zone_size);
    }
}

TEST_CASE("fishplates that do not fit are reported with what is allowed") {
  const auto complaint = [](auto change) {
    scene::MeshSource source = plate_source();
    change(source.fishplate);
    return complaint_of(source);
  };
  CHECK_THAT(complaint([](auto& p) { p.thickness = 0.06; }),
             ContainsSubstring("[meshes.plate] (line 7): thickness = 0.06; allowed: 0.0") &&
                 ContainsSubstring("so that the plate lies on head and foot of 54E1"));
  CHECK_THAT(complaint([](auto& p) { p.end = -1; }), ContainsSubstring("end = -1; allowed: more than start"));
  CHECK_THAT(complaint([](auto& p) { p.gap_end = 0.5; }), ContainsSubstring("gap_end = 0.5; allowed: less than end"));
  CHECK_THAT(complaint([](auto& p) { p.rail_mesh.zone_size = 0.5; }), ContainsSubstring("[meshes.rail]"));
}

TEST_CASE("a rail's fishing surfaces are the sides of its chambers") {
  scene::MeshSource source = rail_of(plate_source());
  source.rail.inclination = 0;
  for (const char* section : {"54E1", "60E1"}) {
    source.rail.section = section;
    const Mesh rail = rail_mesh(source);
    const double length = source.rail.end - source.rail.start, height = section[0] == '5' ? 0.1136 : 0.126;
    for (const char* surface : {"fishing_left", "fishing_right"}) {
      const double outwards = std::string(surface) == "fishing_left" ? -1 : 1;
      INFO(section << " " << surface);
      const Vec3 sum = area_vector(rail, rail.surfaces.at(surface));
      // Projected sideways: from the toe's rounding up to the head's lower corner. Upwards: foot beyond the head.
      CHECK_THAT(outwards * sum[1], WithinRel(height * length, 0.02));
      CHECK(sum[2] > 0);
      CHECK_THAT(sum[0], WithinAbs(0, 1e-12));
      double low = 1, high = 0;
      for (const Face& face : rail.surfaces.at(surface)) {
        const Vec3 area = area_vector(rail, face);
        double y = 0, z = 0;
        for (int n : rail.face_nodes(face)) y += outwards * rail.nodes[n][1] / 4, z += rail.nodes[n][2] / 4;
        CHECK(y > 0.007);
        low = std::min(low, z);
        high = std::max(high, z);
        if (y > 0.02)
          CHECK(area[2] * (z - 0.07) < 0);  // under the head it looks down, on the foot up
        else if (std::abs(z - 0.07) < 0.02)
          CHECK(outwards * area[1] > 0.99 * std::sqrt(area[1] * area[1] + area[2] * area[2]));
      }
      CHECK(low < 0.02);
      CHECK(high > 0.115);
    }
  }
}
