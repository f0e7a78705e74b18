#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "complaint.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/quality.hpp"
#include "mesh/sections/profiles.hpp"
#include "mesh/sections/section.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource rail_source() {
  scene::MeshSource source;
  source.name = "rail";
  source.line = 17;
  source.type = scene::MeshType::rail;
  source.rail.end = 0.42;
  return source;
}

/// Position before inclination.
Vec3 upright(const Vec3& p, double inclination) {
  const double angle = std::atan(inclination), c = std::cos(angle), s = std::sin(angle);
  return {p[0], p[1] * c + p[2] * s, -p[1] * s + p[2] * c};
}

void check_sound(const Mesh& mesh, double zone_size, double least_step, double largest_ratio) {
  const MeshQuality quality = mesh_quality(mesh, 1);
  CHECK(quality.inverted == 0);
  CHECK(quality.jacobian_ratio.value > 0.1);
  CHECK(quality.step.value > least_step * zone_size);
  const Topology found = topology(mesh);
  check_solid(found, 2);
  CHECK(found.largest_size_ratio < largest_ratio);
}

}  // namespace

TEST_CASE("The rail of the main case is a sound mesh within its budget") {
  const scene::MeshSource source = rail_source();
  const Mesh mesh = rail_mesh(source);
  check_sound(mesh, 0.002, 0.65, 4);
  CHECK(mesh.elements.size() < 30000);
}

TEST_CASE("The meshed section has the rail's area and second moments") {
  scene::MeshSource source = rail_source();
  source.rail.inclination = 0;
  const struct {
    const char* name;
    double area, vertical, lateral;
  } nominal[] = {{"54E1", 69.77e-4, 2337.9e-8, 419.2e-8}, {"60E1", 76.70e-4, 3038.3e-8, 512.3e-8}};
  for (const auto& rail : nominal) {
    source.rail.section = rail.name;
    const Mesh mesh = rail_mesh(source);
    const SectionProperties p = section_properties(mesh, mesh.surfaces.at("start_face"));
    INFO(rail.name);
    CHECK_THAT(p.area, WithinRel(rail.area, 0.01));
    CHECK_THAT(p.moment_y, WithinRel(rail.vertical, 0.01));
    CHECK_THAT(p.moment_z, WithinRel(rail.lateral, 0.01));
    CHECK_THAT(mesh_quality(mesh, 1).volume, WithinRel(p.area * 0.72, 1e-9));
  }
}

TEST_CASE("The inclined crown lies towards the track's centre") {
  const Mesh mesh = rail_mesh(rail_source());
  double crown = -1, crown_y = 0;
  for (const Vec3& p : mesh.nodes) {
    const Vec3 q = upright(p, 0.025);
    if (q[2] > crown) crown = q[2], crown_y = p[1] - q[1];
  }
  CHECK_THAT(crown, WithinAbs(0.159, 2e-6));  // no node need lie on the crown's middle
  CHECK_THAT(crown_y, WithinAbs(-0.159 * std::sin(std::atan(0.025)), 2e-5));
}

TEST_CASE("The contact band lies on the profile, about the zone's centre, in the zone's size") {
  const scene::MeshSource source = rail_source();
  const Mesh mesh = rail_mesh(source);
  double low = 1, high = -1;
  for (const Face& face : mesh.surfaces.at("head"))
    for (int n : mesh.face_nodes(face)) {
      const Vec3 q = upright(mesh.nodes[n], 0.025);
      const double y = std::abs(q[1]);
      if (y > 0.0248) continue;
      const double r300 = 0.159 - 0.3 + std::sqrt(0.09 - y * y);
      const double joint = 0.010012, lean = joint / 0.3, rise = std::sqrt(1 - lean * lean);  // R80 touches R300 there
      const double cy = 0.22 * lean, cz = 0.159 - 0.3 + 0.22 * rise;
      const double r80 = cz + std::sqrt(0.0064 - (y - cy) * (y - cy));
      CHECK_THAT(q[2], WithinAbs(y < joint ? r300 : r80, 1e-9));
      low = std::min(low, mesh.nodes[n][1]);
      high = std::max(high, mesh.nodes[n][1]);
    }
  CHECK(low < -0.003 - 0.015);
  CHECK(high > -0.003 + 0.015);
  const auto& zone = mesh.element_sets.at("zone");
  CHECK(zone.size() == 15u * 3u * 80u);
  const auto [shortest, longest] = edge_range(mesh, zone);
  CHECK(shortest > 0.9 * 0.002);
  CHECK(longest < 1.02 * 0.002);
}

TEST_CASE("Sets of a rail lie where their names say") {
  const Mesh mesh = rail_mesh(rail_source());
  CHECK(mesh.node_sets.at("foot").size() > 100);
  for (int n : mesh.node_sets.at("foot")) CHECK_THAT(upright(mesh.nodes[n], 0.025)[2], WithinAbs(0, 1e-12));
  for (int n : mesh.node_sets.at("start")) CHECK_THAT(mesh.nodes[n][0], WithinAbs(-0.3, 1e-12));
  for (int n : mesh.node_sets.at("end")) CHECK_THAT(mesh.nodes[n][0], WithinAbs(0.42, 1e-12));
  CHECK(mesh.node_sets.at("start").size() == mesh.node_sets.at("end").size());
  CHECK(mesh.surfaces.at("running_surface").size() > mesh.surfaces.at("head").size());
  for (const Face& face : mesh.surfaces.at("head")) {
    const auto c = mesh.face_nodes(face);
    const Vec3 &a = mesh.nodes[c[0]], &b = mesh.nodes[c[1]], &d = mesh.nodes[c[3]];
    CHECK((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) > 0);  // faces turn outwards, upwards
    CHECK(a[0] > -0.03);
    CHECK(a[0] < 0.15);
  }
}

TEST_CASE("Rails of other sizes, zones and sections are sound") {
  const auto with = [](auto change) {
    scene::MeshSource source = rail_source();
    source.rail.start = -0.15;
    source.rail.end = 0.2;
    source.rail.zone_start = 0;
    source.rail.zone_end = 0.03;
    change(source.rail);
    return source;
  };
  const std::pair<const char*, scene::MeshSource> cases[] = {
      {"1 mm", with([](auto& r) { r.zone_size = 0.001; })},
      {"4 mm", with([](auto& r) { r.zone_size = 0.004; })},
      {"60E1", with([](auto& r) { r.section = "60E1"; })},
      {"one layer", with([](auto& r) { r.zone_layers = 1; })},
      {"five layers", with([](auto& r) { r.zone_layers = 5; })},
      {"narrow band", with([](auto& r) { r.zone_width = 0.01; })},
      {"wide band", with([](auto& r) { r.zone_width = 0.05; })},
      {"gauge side", with([](auto& r) { r.zone_centre = -0.02; })},
      {"gauge corner", with([](auto& r) { r.zone_centre = -0.03, r.zone_width = 0.02; })},
      {"field side", with([](auto& r) { r.zone_centre = 0.01; })},
      {"two web columns", with([](auto& r) { r.web_columns = 2; })},
      {"five web columns", with([](auto& r) { r.web_columns = 5; })},
      {"fine section", with([](auto& r) { r.section_size = 0.004; })},
      {"all zone", with([](auto& r) { r.zone_start = -0.15, r.zone_end = 0.2; })},
      {"zone beyond 0", with([](auto& r) { r.zone_start = 0.05, r.zone_end = 0.1; })},
      {"steep growth", with([](auto& r) { r.growth = 1.6; })},
  };
  for (const auto& [name, source] : cases) {
    INFO(name);
    check_sound(rail_mesh(source), source.rail.zone_size, 0.44, 6);
  }
}

TEST_CASE("Rail parameters that do not fit are named with what is allowed") {
  const auto complaint = [](auto change) -> std::string {
    scene::MeshSource source = rail_source();
    change(source.rail);
    return complaint_of(source);
  };
  CHECK_THAT(complaint([](auto& r) { r.section = "49E5"; }),
             ContainsSubstring("[meshes.rail] (line 17): section = 49E5; allowed"));
  CHECK_THAT(complaint([](auto& r) { r.end = -1; }), ContainsSubstring("more than start = -0.3 m"));
  CHECK_THAT(complaint([](auto& r) { r.zone_end = 0.5; }), ContainsSubstring("end = 0.42 m or less"));
  CHECK_THAT(complaint([](auto& r) { r.zone_size = 0; }), ContainsSubstring("0.0001 to 0.01 m"));
  CHECK_THAT(complaint([](auto& r) { r.zone_centre = 0.06; }), ContainsSubstring("zone_centre"));
  CHECK_THAT(complaint([](auto& r) { r.zone_centre = 0.02, r.zone_width = 0.08; }),
             ContainsSubstring("reduce zone_width"));
  CHECK_THAT(complaint([](auto& r) { r.zone_layers = 15; }), ContainsSubstring("zone_layers"));
  CHECK_THAT(complaint([](auto& r) { r.growth = 1, r.core_size = 0.001; }),
             ContainsSubstring("growth = 1") && ContainsSubstring("core_size = 0.001"));
}
