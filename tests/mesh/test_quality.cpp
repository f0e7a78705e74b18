#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "mesh/quality.hpp"
#include "mesh/sections/section.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

Mesh two_blocks() {  // a unit cube and, on top of it in z, a block 0.1 high
  Mesh mesh;
  for (double z : {0.0, 1.0, 1.1})
    for (auto [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) mesh.nodes.push_back({x, y, z});
  mesh.elements = {{0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 8, 9, 10, 11}};
  return mesh;
}

}  // namespace

TEST_CASE("Quality finds the thin element, its step and place") {
  const MeshQuality quality = mesh_quality(two_blocks(), 5000);
  CHECK(quality.elements == 2);
  CHECK(quality.nodes == 12);
  CHECK(quality.inverted == 0);
  CHECK_THAT(quality.volume, WithinRel(1.1, 1e-12));
  CHECK(quality.step.element == 1);
  CHECK_THAT(quality.step.value, WithinRel(0.1 / 5000, 1e-12));
  CHECK_THAT(quality.step.centroid[2], WithinRel(1.05, 1e-12));
  CHECK(quality.aspect_ratio.element == 1);
  CHECK_THAT(quality.aspect_ratio.value, WithinRel(10, 1e-12));
  CHECK_THAT(quality.jacobian_ratio.value, WithinRel(1, 1e-12));
  CHECK_THAT(describe(quality), ContainsSubstring("element 1 at (0.5000, 0.5000, 1.0500) m"));
  CHECK_THAT(describe(quality), !ContainsSubstring("inverted"));
}

TEST_CASE("Quality counts inverted elements") {
  Mesh mesh = two_blocks();
  mesh.nodes[10] = {1, 1, 0.9};  // pushed through the face below it
  const MeshQuality quality = mesh_quality(mesh, 5000);
  CHECK(quality.inverted == 1);
  CHECK(quality.jacobian_ratio.value < 0);
  CHECK(quality.jacobian_ratio.element == 1);
  CHECK_THAT(describe(quality), ContainsSubstring("1 inverted elements"));
}

TEST_CASE("A sheared element has the volume over the largest face as its length") {
  Mesh mesh = two_blocks();
  mesh.elements.resize(1);
  for (int n = 4; n < 8; ++n) mesh.nodes[n][0] += 1;  // sheared by 45 degrees: side faces of area sqrt 2
  CHECK_THAT(mesh_quality(mesh, 1).step.value, WithinRel(1 / std::sqrt(2.0), 1e-12));
}

TEST_CASE("An empty mesh has no extremes to describe") {
  CHECK_THAT(describe(mesh_quality(Mesh{}, 5000)), ContainsSubstring("0 elements"));
}

TEST_CASE("Section properties of a rectangle, turned and moved") {
  const double width = 0.3, height = 0.1, angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  Mesh mesh;
  for (double x : {0.0, 1.0})
    for (auto [y, z] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
      const double u = y * width / 2, v = z * height / 2;
      mesh.nodes.push_back({x, 2 + u * c - v * s, 3 + u * s + v * c});
    }
  mesh.elements = {{0, 1, 2, 3, 4, 5, 6, 7}};
  const double strong = height * std::pow(width, 3) / 12, weak = width * std::pow(height, 3) / 12;
  for (int side : {0, 1}) {  // the sign of the face's turn must not matter
    const SectionProperties p = section_properties(mesh, {{0, side}});
    CHECK_THAT(p.area, WithinRel(width * height, 1e-12));
    CHECK_THAT(p.centroid_y, WithinRel(2, 1e-12));
    CHECK_THAT(p.centroid_z, WithinRel(3, 1e-12));
    CHECK_THAT(p.greatest_moment, WithinRel(strong, 1e-9));
    CHECK_THAT(p.least_moment, WithinRel(weak, 1e-9));
    CHECK_THAT(p.moment_y, WithinRel(strong * s * s + weak * c * c, 1e-9));
    CHECK_THAT(p.product, WithinRel((strong - weak) * s * c, 1e-9));
  }
}
