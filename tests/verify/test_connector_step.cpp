#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

/// A ball of 2 kg on `count` springs side by side between it and the ground.
scene::Scene ball_on_springs(int count, double stiffness, double damping) {
  scene::Scene scene;
  scene.path = "ball";
  add_point(scene, "ball", 2, {0, 0, 0});
  for (int k = 0; k < count; ++k) add_spring(scene, "ground", "ball", {stiffness, 0, 0}, {damping, 0, 0});
  scene.time.end = 1;
  return scene;
}

}  // namespace

TEST_CASE("a spring's and a dashpot's stable steps are 2/omega and 2 m/c, and springs side by side add up") {
  {
    Model model;
    build_model(ball_on_springs(1, 8e4, 0), model);
    CHECK_THAT(model.stable_step.connector, WithinRel(2 / std::sqrt(8e4 / 2), 1e-12));
  }
  {
    Model model;
    build_model(ball_on_springs(1, 0, 300), model);
    CHECK_THAT(model.stable_step.connector, WithinRel(2 * 2.0 / 300, 1e-12));
  }
  for (int count : {1, 4, 7})
    for (double damping : {0.0, 400.0}) {
      Model model;
      build_model(ball_on_springs(count, 8e4, damping), model);
      set_velocity(model, [](const Vec3&, int) { return Vec3{1, 0, 0}; });
      double fastest = 0;
      march(model, std::min(model.step_count, 1000L), [&] { fastest = std::max(fastest, largest_speed(model)); });
      INFO(count << " springs, damping " << damping << ": fastest " << fastest);
      // Velocities at whole steps exceed the first one by the scheme's phase error at most.
      CHECK(fastest < 3);
    }
}

TEST_CASE("a connector on a block's single node is stable at the step chosen") {
  for (double share : {0.3, 0.9}) {
    scene::Scene scene = block_scene({0.03, 0.03, 0.03}, {3, 3, 3}, 1e-3);
    Assembly assembly = assemble(scene);
    assembly.node_sets["block.corner"] = {0};
    // As stiff as the corner's mass and the elements' step allow, times the share.
    const double omega = 2 / (0.01 / steel().dilatational_speed());
    const double k = share * omega * omega * 7800 * 1e-6 / 8;
    add_spring(scene, "ground", "block.corner", {k, k, k});
    Model model;
    build_model(scene, assembly, model);
    set_velocity(model, [](const Vec3& x, int) {
      return 1e-3 * Vec3{std::sin(900 * x[0] + 1), std::sin(700 * x[1]), std::sin(1100 * x[2])};
    });
    double fastest = 0;
    march(model, 2000, [&] {
      if (model.step % 50 == 0) fastest = std::max(fastest, largest_speed(model));
    });
    INFO("share " << share << ", fastest " << fastest);
    CHECK(fastest < 0.05);
  }
}
