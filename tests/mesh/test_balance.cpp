#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <set>

#include "complaint.hpp"
#include "mesh/body_balance.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/generators/wheel.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/quality.hpp"
#include "mesh/sections/wheel_section.hpp"
#include "round_bodies.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Of a mesh of density 1, its mass lumped at the nodes as a model lumps it.
struct Body {
  double volume = 0;
  Vec3 centre{0, 0, 0};
  std::vector<double> mass;
};

Body body_of(const Mesh& mesh) {
  Body body;
  body.mass.assign(mesh.nodes.size(), 0);
  for (const auto& element : mesh.elements) {
    const auto integrals = hexahedron_shape_integrals(corners_of(mesh.nodes, element));
    for (int N = 0; N < 8; ++N) body.mass[element[N]] += integrals[N];
  }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    body.volume += body.mass[n];
    for (int i = 0; i < 3; ++i) body.centre[i] += body.mass[n] * mesh.nodes[n][i];
  }
  for (double& x : body.centre) x /= body.volume;
  return body;
}

/// Volume of a section turned about the axle and its centre's y, by Pappus, of triangles.
struct Turned {
  double volume = 0, y = 0;
};

Turned turned(const SectionMesh& section) {
  Turned body;
  for (const SectionQuad& quad : section.quads)
    for (int i = 1; i < 3; ++i) {
      const Point2 a = section.position(quad.nodes[0]), b = section.position(quad.nodes[i]),
                   c = section.position(quad.nodes[i + 1]);
      const double part = 2 * M_PI * cross(b - a, c - a) / 2;
      const double radii = a.z + b.z + c.z;
      body.volume += part * radii / 3;
      // The integral of y r over a triangle.
      body.y += part * ((a.y + b.y + c.y) * radii + a.y * a.z + b.y * b.z + c.y * c.z) / 12;
    }
  body.y /= body.volume;
  return body;
}

scene::WheelMesh wheel(double zone_size, double zone_start, double zone_length) {
  scene::WheelMesh w;
  w.zone_size = zone_size;
  w.zone_start = zone_start;
  w.zone_length = zone_length;
  w.zone_centre = 0.005;
  return w;
}

scene::MeshSource source_of(const scene::WheelMesh& w) {
  scene::MeshSource source = named(scene::MeshType::wheel);
  source.wheel = w;
  return source;
}

scene::MeshSource whole_roller(double zone_size, int zone_layers) {
  scene::MeshSource source = named(scene::MeshType::roller);
  source.roller.ring = true;
  source.roller.zone_size = zone_size;
  source.roller.zone_layers = zone_layers;
  return source;
}

SectionMesh section_of(const scene::WheelMesh& w) { return wheel_section(w, wheel_stations(w).levels.size() == 3); }

/// The wheel as its section is turned, all nodes on true circles: what cells of different widths put out of balance.
Mesh turned_only(const scene::WheelMesh& w) {
  const auto place = [&](Point2 p, double arc) {
    return Vec3{p.z * std::sin(arc / w.radius), p.y, -p.z * std::cos(arc / w.radius)};
  };
  return extrude(section_of(w), wheel_stations(w), place, true).mesh;
}

/// A mesh's centre must lie on the axle to this, m: rounding of sums over some hundred thousand cells.
constexpr double on_axle = 1e-12;

void check_wheel(const scene::WheelMesh& w) {
  const Mesh mesh = build_mesh(source_of(w)), plain = turned_only(w);
  const Turned exact = turned(section_of(w));
  const Body body = body_of(mesh), before = body_of(plain);
  INFO("turned only: centre " << 1e6 * before.centre[0] << ", " << 1e6 * before.centre[2] << " um, volume "
                              << before.volume / exact.volume - 1 << ", y " << 1e6 * (before.centre[1] - exact.y)
                              << " um; balanced: y " << 1e6 * (body.centre[1] - exact.y) << " um");
  CHECK_THAT(body.centre[0], WithinAbs(0, on_axle));
  CHECK_THAT(body.centre[2], WithinAbs(0, on_axle));
  CHECK_THAT(body.volume, WithinRel(exact.volume, 1e-11));
  // The rim's inner side takes what the tread's chords lack, and its middle lies a little aside.
  CHECK_THAT(body.centre[1], WithinAbs(exact.y, std::fmax(2e-6, 0.25 * std::fabs(before.centre[1] - exact.y))));

  const MeshQuality quality = mesh_quality(mesh, 1), old = mesh_quality(plain, 1);
  CHECK(quality.jacobian_ratio.value > 0.99 * old.jacobian_ratio.value);
  CHECK(quality.step.value > 0.99 * old.step.value);
  CHECK(quality.aspect_ratio.value < 1.01 * old.aspect_ratio.value);

  // The zone, and the running surface all round, lie where they lay, to the last bit.
  std::set<int> true_nodes;
  for (int e : mesh.element_sets.at("zone")) true_nodes.insert(mesh.elements[e].begin(), mesh.elements[e].end());
  for (const Face& face : mesh.surfaces.at("running_surface"))
    for (int n : mesh.face_nodes(face)) true_nodes.insert(n);
  std::size_t moved = 0;
  for (int n : true_nodes)
    if (mesh.nodes[n] != plain.nodes[n]) ++moved;
  CHECK(moved == 0);

  // No node moves farther than chords lie off their circles, and none round the axle or along it.
  const double widest = 2 * std::fmax(w.coarse_size, w.core_size) / w.radius;
  double farthest = 0, aside = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3 &x = mesh.nodes[n], &from = plain.nodes[n];
    const double radius = radius_of(from);
    farthest = std::fmax(farthest, std::fabs(radius_of(x) / radius - 1));
    aside = std::fmax(aside, std::fabs(x[0] * from[2] - x[2] * from[0]) / radius + std::fabs(x[1] - from[1]));
  }
  CHECK(farthest < widest * widest / 8);
  CHECK(aside < 1e-15);
}

}  // namespace

TEST_CASE("A wheel's centre of mass lies on its axle for all sizes and zones, its volume is its turned section's") {
  for (const double size : {0.002, 0.004, 0.008})
    for (const double length : {0.02, 0.16, 1.4, 2.7})
      for (const double start : {-0.02, -1.1, 0.5}) {
        if (size < 0.008 && length > 1 && start != 0.5) continue;  // many elements
        CAPTURE(size, length, start);
        scene::WheelMesh w = wheel(size, start, length);
        if (size > 0.005) w.zone_layers = 1, w.section_size = 0.012;
        check_wheel(w);
      }
}

TEST_CASE("Wheels of other layers, shapes and paths are balanced too") {
  const auto with = [](auto change) {
    scene::WheelMesh w = wheel(0.004, -0.02, 0.16);
    change(w);
    return w;
  };
  const std::pair<const char*, scene::WheelMesh> wheels[] = {
      {"1 mm", with([](auto& w) { w.zone_size = 0.001, w.zone_length = 0.03; })},
      {"one layer", with([](auto& w) { w.zone_layers = 1; })},
      {"five layers", with([](auto& w) { w.zone_layers = 5; })},
      {"smaller", with([](auto& w) { w.radius = 0.42, w.rim_inner_radius = 0.36, w.web_outer_radius = 0.33; })},
      {"larger", with([](auto& w) { w.radius = 0.5; })},
      {"coarse", with([](auto& w) { w.coarse_size = 0.06, w.core_size = 0.18; })},
      {"even", with([](auto& w) { w.coarse_size = w.core_size = 0.012; })},
      {"fast growth", with([](auto& w) { w.growth = 1.5; })},
      {"flange root", with([](auto& w) { w.zone_centre = -0.038, w.zone_width = 0.02; })},
      {"no chamfer", with([](auto& w) { w.rim_width = 0.13; })},
      {"cone", with([](auto& w) { w.profile = "cone", w.conicity = 0.1; })},
      {"path", with([](auto& w) { w.path_start = -0.7, w.path_size = 0.008; })},
      {"coarse path", with([](auto& w) { w.path_start = -0.02, w.path_length = 0.8, w.path_size = 0.02; })},
      {"path round", with([](auto& w) { w.path_start = -1.3, w.path_length = 2.7, w.path_size = 0.012; })},
      {"all round", with([](auto& w) { w.zone_size = 0.008, w.zone_layers = 1, w.zone_length = 2.89; })},
  };
  for (const auto& [name, w] : wheels) {
    INFO(name);
    check_wheel(w);
  }
}

TEST_CASE("The bore's nodes have their centre of mass on the axle: about it a case lets a wheel turn") {
  const Mesh mesh = build_mesh(source_of(wheel(0.002, -0.02, 0.16)));
  const Body body = body_of(mesh);
  double x = 0, z = 0, mass = 0;
  for (int n : mesh.node_sets.at("bore")) {
    x += body.mass[n] * mesh.nodes[n][0];
    z += body.mass[n] * mesh.nodes[n][2];
    mass += body.mass[n];
  }
  // A hub's cells are turned sections: lumped masses have the moment of the polygon, which is 0.
  CHECK_THAT(x / mass, WithinAbs(0, 1e-9));
  CHECK_THAT(z / mass, WithinAbs(0, 1e-9));
}

TEST_CASE("A wheelset's centre of mass lies on its axle, and its axle has the lathe's volume") {
  for (const double size : {0.002, 0.004, 0.008})
    for (const double length : {0.16, 0.9})
      for (const bool half : {true, false}) {
        if (size < 0.004 && length > 0.5) continue;
        CAPTURE(size, length, half);
        scene::MeshSource source = named(scene::MeshType::wheelset);
        auto& w = source.wheelset;
        w.half = half;
        w.zone_size = size;
        w.zone_length = length;
        w.zone_start = 0.2;
        w.section_size = 0.012;
        w.zone_layers = 1;
        const Mesh mesh = build_mesh(source);
        const Body body = body_of(mesh);
        CHECK_THAT(body.centre[0], WithinAbs(0, on_axle));
        CHECK_THAT(body.centre[2], WithinAbs(0, on_axle));
        if (!half) CHECK_THAT(body.centre[1], WithinAbs(0, on_axle));
        // Cells of 0.2 rad: what is left is of the fourth order.
        CHECK_THAT(body.volume, WithinRel((half ? 1 : 2) * (turned(section_of(w)).volume + axle_volume(w)), 1e-6));
      }
}

TEST_CASE("A whole roller's centre of mass lies on its axle, its tread is exact at every node") {
  for (const double coarse : {0.01, 0.04})
    for (const double crown : {0.0, 0.3})
      for (const double zone_end : {0.01, 1.0}) {
        CAPTURE(coarse, crown, zone_end);
        scene::MeshSource source = whole_roller(0.002, 2);
        auto& r = source.roller;
        r.zone_end = zone_end;
        r.coarse_size = coarse;
        r.crown_radius = crown;
        const Mesh mesh = build_mesh(source);
        const Body body = body_of(mesh);
        CHECK_THAT(body.centre[0], WithinAbs(0, on_axle));
        CHECK_THAT(body.centre[1], WithinAbs(0, on_axle));
        CHECK_THAT(body.centre[2], WithinAbs(0, on_axle));
        if (crown == 0) CHECK_THAT(body.volume, WithinRel(M_PI * (0.46 * 0.46 - 0.4 * 0.4) * 0.08, 1e-10));
        for (int n : mesh.node_sets.at("tread")) {
          const auto [x, y, z] = mesh.nodes[n];
          const double radius = crown == 0 ? 0.46 : 0.46 - crown + std::sqrt(crown * crown - y * y);
          CHECK_THAT(std::hypot(x, z), WithinAbs(radius, 1e-15));
        }
      }
}

TEST_CASE("Cylinders and rings of equal cells are in balance by symmetry") {
  for (const scene::MeshType type : {scene::MeshType::cylinder, scene::MeshType::ring})
    for (const int divisions : {9, 12, 37}) {
      scene::MeshSource source = named(type);
      source.ring.round_divisions = divisions;
      source.cylinder.core_divisions = divisions;
      const Body body = body_of(build_mesh(source));
      const int across = type == scene::MeshType::ring ? 2 : 1;
      CHECK_THAT(body.centre[0], WithinAbs(0, on_axle));
      CHECK_THAT(body.centre[across], WithinAbs(0, on_axle));
    }
}

TEST_CASE("Balanced radii give a polygon the area and the centre of its circle") {
  std::vector<double> angles;
  for (double angle = 0, width = 0.01; angle < 2 * M_PI - 0.1; angle += width *= angle < 3 ? 1.2 : 0.9)
    angles.push_back(angle);
  const auto radii = balanced_radii(angles);
  double area = 0, x = 0, y = 0, widest = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const std::size_t j = (i + 1) % angles.size();
    const double width = j > 0 ? angles[j] - angles[i] : 2 * M_PI - angles[i];
    widest = std::fmax(widest, width);
    const double triangle = 0.5 * radii[i] * radii[j] * std::sin(width);
    area += triangle;
    x += triangle * (radii[i] * std::cos(angles[i]) + radii[j] * std::cos(angles[j])) / 3;
    y += triangle * (radii[i] * std::sin(angles[i]) + radii[j] * std::sin(angles[j])) / 3;
  }
  CAPTURE(widest);
  CHECK_THAT(area, WithinRel(M_PI, std::pow(widest, 4) / 10));
  CHECK_THAT(x, WithinAbs(0, 1e-14));
  CHECK_THAT(y, WithinAbs(0, 1e-14));
}

TEST_CASE("Bodies of a few wide cells are left as they are, with sound numbers") {
  scene::MeshSource source = whole_roller(0.02, 1);
  auto& r = source.roller;
  for (const auto& [bore, coarse] : {std::array<double, 2>{0.4, 1}, {0.02, 0.2}, {0.3, 10}}) {
    CAPTURE(bore, coarse);
    r.bore_radius = bore;
    r.coarse_size = coarse;
    r.growth = 2;
    for (const Vec3& x : build_mesh(source).nodes) {
      const double radius = radius_of(x);
      REQUIRE(radius > 0.89 * bore);
      REQUIRE(radius < 0.46 + 1e-9);
    }
  }
}
