// Element sets picked by place: boxes, positions with a radius, surfaces; what is reported of those that miss.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "mesh/hexahedron.hpp"
#include "model/elements/history_sets.hpp"
#include "model/sets/place_sets.hpp"
#include "tests/verify/block.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

namespace {

/// A block of 4 x 2 x 3 cubes of 1 m, one corner at (10, 0, 0), with one element set.
scene::Scene scene_with(const scene::ElementSet& wanted) {
  scene::Scene scene = verify::block_scene({4, 2, 3}, {4, 2, 3}, 1);
  scene.parts[0].position = {10, 0, 0};
  scene::ElementSet set = wanted;
  set.name = "picked";
  set.part = "block";
  set.line = 7;
  scene.element_sets.push_back(set);
  return scene;
}

scene::ElementSet by_box(const scene::Box& box, const std::string& surface = "") {
  scene::ElementSet set;
  set.box = box;
  set.surface = surface;
  return set;
}

scene::ElementSet by_position(const scene::Vec3& position, double radius = 0, const std::string& surface = "") {
  scene::ElementSet set;
  set.position = position;
  set.radius = radius;
  set.surface = surface;
  return set;
}

std::vector<int> picked(const scene::ElementSet& set) {
  return assemble(scene_with(set)).element_sets.at("block.picked");
}

}  // namespace

TEST_CASE("an element set by box has the elements whose centre is in it, sides included, where the part stands") {
  CHECK(picked(by_box({{{10.5, 0.5, 0.5}, {12.5, 1.4, 2.5}}})).size() == 3 * 1 * 3);
  CHECK(picked(by_box({{{10.6, 0, 0}, {12.4, 2, 3}}})).size() == 1 * 2 * 3);
  CHECK(picked(by_box({{{0, 0, 0}, {99, 9, 9}}}, "z_max")).size() == 4 * 2);
}

TEST_CASE("an element set by position has the element in which that lies, and with a radius those around") {
  const scene::Scene scene = scene_with(by_position({12.3, 1.9, 1.1}));
  const Assembly assembly = assemble(scene);
  REQUIRE(assembly.element_sets.at("block.picked").size() == 1);
  const Vec3 centre = element_centre(assembly, assembly.element_sets.at("block.picked")[0]);
  CHECK(centre == Vec3{12.5, 1.5, 1.5});
  const auto placed = placed_element_sets(scene, assembly);
  REQUIRE(placed.size() == 1);
  CHECK_THAT(placed[0].distance, WithinAbs(std::sqrt(0.04 + 0.16 + 0.16), 1e-12));
  CHECK(placed[0].warning.empty());
  CHECK(picked(by_position({12.5, 1.5, 1.5}, 1.0)).size() == 1 + 5);  // six neighbours, one of them beyond y_max
  CHECK(picked(by_position({12.5, 1.5, 1.5}, 1.0, "y_max")).size() == 1 + 4);
}

TEST_CASE("a place on a face shared by elements is in the first of them, whatever rounding does") {
  const std::vector<int> first = picked(by_position({12, 1, 1}));
  REQUIRE(first.size() == 1);
  for (const double off : {-1e-9, 1e-9}) CHECK(picked(by_position({12 + off, 1 - off, 1 + off})) == first);
}

TEST_CASE("a place outside the part has the nearest element, and a warning that says how far") {
  const scene::Scene scene = scene_with(by_position({12.5, 0.5, 7}));
  const Assembly assembly = assemble(scene);
  CHECK(element_centre(assembly, assembly.element_sets.at("block.picked").at(0)) == Vec3{12.5, 0.5, 2.5});
  CHECK_THAT(placed_element_sets(scene, assembly).at(0).warning,
             ContainsSubstring(
                 "block.picked (line 7) is asked for at [12.5, 0.5, 7] m, which lies in no element of the part") &&
                 ContainsSubstring("4.5 m away at [12.5, 0.5, 2.5] m"));
  // Just off a face, as a place on a curved surface is off its facets.
  CHECK(placed_element_sets(scene_with(by_position({12.5, 0.5, 3.01})),
                            assemble(scene_with(by_position({12.5, 0.5, 3.01}))))
            .at(0)
            .warning.empty());
}

TEST_CASE("an element set without elements names the nearest, and a name that is taken is refused") {
  CHECK_THAT(verify::complaint_of_building(scene_with(by_box({{{10.6, 0.6, 5}, {10.7, 0.7, 6}}}))),
             ContainsSubstring("block:7: [element_sets.picked] box: no element of 'block' has its centre in it; the "
                               "nearest has it at [10.5, 0.5, 2.5] m, 2.504 m away"));
  scene::Scene taken = scene_with(by_box({{{0, 0, 0}, {99, 9, 9}}}));
  taken.element_sets[0].name = "z_max";
  CHECK_THAT(verify::complaint_of_building(taken), ContainsSubstring("the part 'block' has a set 'z_max' already"));
  scene::Scene twice = scene_with(by_box({{{0, 0, 0}, {99, 9, 9}}}));
  twice.element_sets.push_back(twice.element_sets[0]);
  CHECK_THAT(verify::complaint_of_building(twice), ContainsSubstring("the part 'block' has a set 'picked' already"));
  CHECK_THAT(verify::complaint_of_building(scene_with(by_box({{{0, 0, 0}, {99, 9, 9}}}, "top"))),
             ContainsSubstring("there is no set 'block.top'"));
}

TEST_CASE("natural coordinates tell inside from outside in a warped element") {
  HexahedronCorners corners;
  for (int k = 0; k < 8; ++k) {
    const auto& s = hexahedron_corner_signs[k];
    const double x = s[0], y = s[1], z = s[2];
    corners[k] = {x + 0.2 * y * z, y - 0.15 * x * z, 2 * z + 0.3 * x * y};
  }
  const auto map = [&](double x, double y, double z) {
    return Vec3{x + 0.2 * y * z, y - 0.15 * x * z, 2 * z + 0.3 * x * y};
  };
  for (const double place : {0.0, 0.3, 0.999, 1.001, 1.4}) {
    CHECK_THAT(largest_natural_coordinate(corners, map(place, -0.5 * place, 0.2)),
               WithinAbs(std::fmax(place, 0.2), 1e-9));
    CHECK_THAT(largest_natural_coordinate(corners, map(0.1, 0.4, -place)), WithinAbs(std::fmax(place, 0.4), 1e-9));
  }
  const Vec3 far_away{1e6, 0, 0};
  CHECK(largest_natural_coordinate(corners, far_away) > 1);
}

TEST_CASE("history sets are what their names and probes ask for") {
  scene::Scene scene = scene_with(by_box({{{10, 0, 0}, {12, 2, 3}}}));
  scene.output.history_sets = {"block.z_max", "block.picked"};
  auto sets = resolve_history_sets(scene, assemble(scene));
  REQUIRE(sets.size() == 2);
  CHECK((sets[0].motion() && !sets[0].inside()));
  CHECK((!sets[1].motion() && sets[1].has("stress") && sets[1].has("strain") && !sets[1].has("plastic_strain")));
  const Vec3 middle{11, 1, 1.5};
  for (int i = 0; i < 3; ++i) CHECK_THAT(sets[1].element_centre[i], WithinAbs(middle[i], 1e-12));
  scene.materials[0].yield_stress = 1e9;
  CHECK(resolve_history_sets(scene, assemble(scene))[1].has("plastic_strain"));
  scene.output.history_sets = {"block.pickt"};
  CHECK_THAT(verify::complaint_of_building(scene),
             ContainsSubstring("there is no set 'block.pickt'; did you mean 'block.picked'?"));
}
