#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double side = 0.02, length = 0.08, stress = 1e8;

/// A bar with an inclined crack through half its height, pressed or pulled along x.
scene::Scene cracked_bar(double traction) {
  scene::Scene scene = block_scene({length, side, side}, {16, 4, 8}, 1e-5);
  scene::Seam crack;
  crack.name = "crack";
  crack.mesh = "block";
  crack.place = {0.04, 0.01, side};
  crack.length = 1;
  crack.depth = 0.5 * side / std::cos(0.3);
  crack.angle = 0.3;
  scene.seams.push_back(crack);
  scene::Contact faces;
  faces.name = "crack";
  faces.slave = "block.crack_before";
  faces.master = "block.crack_behind";
  faces.friction = 0.4;
  faces.algorithm = scene::ContactAlgorithm::penalty;
  scene.contacts.push_back(faces);
  hold_lower_faces(scene, "block");
  add_traction(scene, "block.x_max", {traction, 0, 0});
  scene.settle.active = true;
  scene.settle.tolerance = 1e-5;
  scene.settle.max_steps = 50000;
  return scene;
}

struct Answer {
  double stretch = 0;  ///< of the bar, of what a whole one has
  double opening = 0;  ///< m, of the mouth
};

Answer answer(double traction) {
  Model model;
  build_model(cracked_bar(traction), model);
  CHECK(settle_whole(model).settled);
  const auto mouth = [&](const char* surface) {
    std::vector<int> top;
    for (int n : model.assembly.node_sets.at(surface))
      if (model.assembly.nodes[n][2] > side - 1e-9) top.push_back(n);
    return mean(model, NodeField::displacement, top)[0];
  };
  return {
      mean(model, NodeField::displacement, model.assembly.node_sets.at("block.x_max"))[0] / (traction * length / 210e9),
      mouth("block.crack_behind") - mouth("block.crack_before")};
}

}  // namespace

TEST_CASE("a crack opens under tension, and carries pressure as whole steel does but for its contact springs") {
  const Answer pulled = answer(stress), pressed = answer(-stress);
  INFO("stretch " << pulled.stretch << " pulled, " << pressed.stretch << " pressed; opening " << pulled.opening
                  << " and " << pressed.opening << " m");
  CHECK(pulled.stretch > 1.1);
  CHECK(pulled.opening > 5e-6);
  CHECK(pressed.stretch > 0.999);
  CHECK(pressed.stretch < 1.06);
  CHECK(std::fabs(pressed.opening) < 0.2 * pulled.opening);
}

TEST_CASE("a seam that its mesh has no room for is reported with the case's line") {
  scene::Scene scene = cracked_bar(stress);
  scene.path = "bar.toml";
  scene.seams[0].line = 12;
  scene.seams[0].depth = 1e-4;
  CHECK_THAT(complaint_of_building(scene), ContainsSubstring("bar.toml:12: [seams.crack]: no layer of element faces"));
}
