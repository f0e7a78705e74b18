#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

double largest_speed(const Model& model) {
  double largest = 0;
  for (double v : node_field(model, model.ties, NodeField::velocity, all_nodes(model)).values)
    largest = std::isfinite(v) ? std::max(largest, std::fabs(v)) : 1e300;
  return largest;
}

/// A ball of 2 kg on `count` springs side by side between it and the ground.
scene::Scene ball_on_springs(int count, double stiffness, double damping) {
  scene::Scene scene;
  scene.path = "ball";
  scene::PointMass ball;
  ball.name = "ball";
  ball.mass = 2;
  scene.points.push_back(ball);
  for (int k = 0; k < count; ++k) {
    scene::Connector connector;
    connector.name = "spring";
    connector.from = "ground";
    connector.to = "ball";
    connector.stiffness = {stiffness, 0, 0};
    connector.damping = {damping, 0, 0};
    scene.connectors.push_back(connector);
  }
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
    scene::Connector connector;
    connector.name = "spring";
    connector.from = "ground";
    connector.to = "block.corner";
    // As stiff as the corner's mass and the elements' step allow, times the share.
    const double omega = 2 / (0.01 / steel().dilatational_speed());
    const double k = share * omega * omega * 7800 * 1e-6 / 8;
    connector.stiffness = {k, k, k};
    scene.connectors.push_back(connector);
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
