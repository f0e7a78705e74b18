#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "model/sets/place_sets.hpp"
#include "tests/verify/block.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

scene::Scene scene_with(const std::string& surface, const scene::Box& box) {
  scene::Scene scene = verify::block_scene({4, 2, 1}, {4, 2, 1}, 1);
  scene.parts[0].position = {10, 0, 0};
  scene::NodeSet set;
  set.name = "picked";
  set.part = "block";
  set.surface = surface;
  set.box = box;
  set.line = 7;
  scene.node_sets.push_back(set);
  return scene;
}

std::string complaint(const scene::Scene& scene) {
  try {
    assemble(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a node set by place has the nodes in its box, sides included, where the part stands") {
  const Assembly assembly = assemble(scene_with("", {{{11, 0, 0}, {13, 1, 1}}}));
  CHECK(assembly.node_sets.at("block.picked").size() == 3 * 2 * 2);
  for (int n : assembly.node_sets.at("block.picked"))
    CHECK((assembly.nodes[n][0] >= 11 && assembly.nodes[n][0] <= 13 && assembly.nodes[n][1] <= 1));
  CHECK(assembly.surfaces.count("block.picked") == 0);
}

TEST_CASE("of a surface a set by place has its nodes and whole faces only") {
  const Assembly assembly = assemble(scene_with("z_max", {{{11, 0, -5}, {13.5, 2, 5}}}));
  CHECK(assembly.node_sets.at("block.picked").size() == 3 * 3);
  CHECK(assembly.surfaces.at("block.picked").size() == 2 * 2);
  for (int n : assembly.node_sets.at("block.picked")) CHECK(assembly.nodes[n][2] == 1);
}

TEST_CASE("a set by place without nodes tells the nearest one, and a name that is taken") {
  CHECK_THAT(complaint(scene_with("z_max", {{{11.2, 0.5, 1}, {11.4, 0.6, 2}}})),
             ContainsSubstring("block:7: [node_sets.picked] box: no node of 'block.z_max' is in it; the nearest is at "
                               "[11, 1, 1] m, 0.4472 m away"));
  scene::Scene taken = scene_with("", {{{0, 0, 0}, {99, 9, 9}}});
  taken.node_sets[0].name = "z_min";
  CHECK_THAT(complaint(taken), ContainsSubstring("the part 'block' has a set 'z_min' already"));
  CHECK_THAT(complaint(scene_with("top", {{{0, 0, 0}, {99, 9, 9}}})), ContainsSubstring("there is no set 'block.top'"));
}

TEST_CASE("a node set by position has the nodes within its radius, and the nearest one in any case") {
  scene::Scene scene = scene_with("z_max", {});
  scene.node_sets[0].box.reset();
  scene.node_sets[0].position = scene::Vec3{12, 1, 1.2};
  scene.node_sets[0].radius = 1.1;
  CHECK(assemble(scene).node_sets.at("block.picked").size() == 5);
  scene.node_sets[0].radius = 0;
  const Assembly assembly = assemble(scene);
  REQUIRE(assembly.node_sets.at("block.picked").size() == 1);
  CHECK(assembly.nodes[assembly.node_sets.at("block.picked")[0]] == Vec3{12, 1, 1});
  CHECK(assembly.surfaces.count("block.picked") == 0);

  const auto placed = placed_sets(scene, assembly);
  REQUIRE(placed.size() == 1);
  CHECK(placed[0].count == 1);
  CHECK(std::abs(placed[0].distance - 0.2) < 1e-12);
  CHECK(placed[0].warning.empty());
}

TEST_CASE("a position farther from the nearest node than an element is warned of") {
  scene::Scene scene = scene_with("", {});
  scene.node_sets[0].box.reset();
  scene.node_sets[0].position = scene::Vec3{12, 1, 2.5};
  CHECK_THAT(
      placed_sets(scene, assemble(scene))[0].warning,
      ContainsSubstring(
          "block.picked (line 7) is asked for at [12, 1, 2.5] m, but the nearest node is 1.5 m away, at [12, 1, 1] m"));
  scene.node_sets[0].radius = 0.6;
  CHECK(placed_sets(scene, assemble(scene))[0].warning.empty());
}

TEST_CASE("a blow on a patch that is small beside the elements is warned of") {
  scene::Scene scene = scene_with("z_max", {});
  scene.node_sets[0].box.reset();
  scene.node_sets[0].position = scene::Vec3{12, 1, 1};
  CHECK(placed_sets(scene, assemble(scene))[0].warning.empty());
  scene::Hammer hammer;
  hammer.name = "picked";
  hammer.part = "block";
  hammer.line = 7;
  scene.hammers.push_back(hammer);
  CHECK_THAT(placed_sets(scene, assemble(scene))[0].warning,
             ContainsSubstring("[hammers.picked] (line 7) strikes within 0 m of its position, among elements of 1 m"));
  scene.node_sets[0].radius = 0.5;
  CHECK(placed_sets(scene, assemble(scene))[0].warning.empty());
}
