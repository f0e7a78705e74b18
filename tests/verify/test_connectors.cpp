#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A point mass "ball" on a connector to the ground; `steps` steps in one second.
scene::Scene ball_scene(double mass, const Vec3& stiffness, const Vec3& damping, int steps) {
  scene::Scene scene;
  scene.path = "ball";
  add_point(scene, "ball", mass, {1, 2, 3});
  add_spring(scene, "ground", "ball", stiffness, damping);
  scene.time.end = 1;
  scene.time.step = 1.0 / steps;
  return scene;
}

/// Displacement of the ball along `axis` at every step.
std::vector<double> displacement_along(Model& model, const Vec3& axis) {
  set_initial_motion(model, model.nodes, model.beams);
  std::vector<double> along;
  march(model, model.step_count, [&] { along.push_back(dot(axis, mean(model, NodeField::displacement, {0}))); });
  return along;
}

}  // namespace

TEST_CASE("a mass on a spring swings with sqrt(k/m) along each of the connector's oblique axes") {
  const auto axes = oblique_axes();
  const Vec3 stiffness{3e3, 8e3, 2e4};
  for (int a = 0; a < 3; ++a) {
    const double omega = std::sqrt(stiffness[a] / 2.0);
    scene::Scene scene = ball_scene(2.0, stiffness, {0, 0, 0}, static_cast<int>(200 * omega / (2 * M_PI)));
    scene.connectors[0].axes = axes;
    add_motion(scene, {"ball"}, 0.1 * axes[a]);
    Model model;
    build_model(scene, model);
    const auto along = displacement_along(model, axes[a]);
    // The scheme's own error at 200 steps a period is (omega step)^2/24 = 4e-5.
    CHECK_THAT(angular_frequency(along, model.step_size), WithinRel(omega, 1e-3));
    double largest = 0;
    for (double u : along) largest = std::max(largest, std::fabs(u));
    CHECK_THAT(largest, WithinRel(0.1 / omega, 1e-3));
    const Vec3 u = mean(model, NodeField::displacement, {0});
    for (int b = 0; b < 3; ++b)
      if (b != a) CHECK_THAT(dot(axes[b], u), WithinAbs(0, 1e-12));
  }
}

TEST_CASE("a dashpot stops a mass exponentially, and damps a spring by its logarithmic decrement") {
  const auto axes = oblique_axes();
  {
    scene::Scene scene = ball_scene(2.0, {0, 0, 0}, {6, 0, 0}, 2000);
    scene.connectors[0].axes = axes;
    add_motion(scene, {"ball"}, 0.5 * axes[0] + 0.2 * axes[1]);
    Model model;
    build_model(scene, model);
    displacement_along(model, axes[0]);
    const Vec3 v = mean(model, NodeField::velocity, {0});
    CHECK_THAT(dot(axes[0], v), WithinRel(0.5 * std::exp(-3.0), 0.01));
    CHECK_THAT(dot(axes[1], v), WithinRel(0.2, 1e-12));
  }
  const double mass = 2, omega = 2 * M_PI * 10, ratio = 0.03;
  scene::Scene scene = ball_scene(mass, {0, 0, mass * omega * omega}, {0, 0, 2 * ratio * mass * omega}, 5000);
  add_motion(scene, {"ball"}, {0, 0, 0.1});
  Model model;
  build_model(scene, model);
  const auto u = displacement_along(model, {0, 0, 1});
  std::vector<double> peaks;
  for (std::size_t k = 1; k + 1 < u.size(); ++k)
    if (u[k] > u[k - 1] && u[k] >= u[k + 1]) peaks.push_back(u[k]);
  REQUIRE(peaks.size() == 10);
  const double decrement = std::log(peaks.front() / peaks.back()) / 9;
  CHECK_THAT(decrement, WithinRel(2 * M_PI * ratio / std::sqrt(1 - ratio * ratio), 0.01));
}

TEST_CASE("a preload that carries the weight leaves a mass at rest") {
  scene::Scene scene = ball_scene(1234.5, {1e5, 2e5, 1.15e6}, {100, 200, 2.5e3}, 1000);
  scene.gravity = {0.3, 0, -9.81};
  scene.connectors[0].preload = {-0.3 * 1234.5, 0, 9.81 * 1234.5};
  scene.connectors[0].axes = oblique_axes();
  Model model;
  build_model(scene, model);
  double moved = 0;
  march(model, model.step_count, [&] { moved = std::max(moved, norm(mean(model, NodeField::displacement, {0}))); });
  CHECK(moved < 1e-14);
  // Its static deflection without the preload would be 1 cm.
  CHECK_THAT(balance_total(account_energies(model, model.step_size)), WithinAbs(0, 1e-9));
}

TEST_CASE("two masses on a spring keep their momentum and swing with the reduced mass") {
  scene::Scene scene;
  scene.path = "pair";
  add_point(scene, "a", 1.0, {0, 0, 0});
  add_point(scene, "b", 3.0, {1, 0, 0});
  add_spring(scene, "a", "b", {3e3, 3e3, 3e3}, {0.5, 0, 0});
  add_motion(scene, {"a"}, {1, 2, 0});
  scene.time.end = 1;
  scene.time.step = 5e-4;
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  std::vector<double> apart;
  double worst = 0;
  march(model, model.step_count, [&] {
    const auto v = to_host(model.nodes.velocity);
    for (int i = 0; i < 3; ++i)
      worst = std::max(worst, std::fabs(v(0, i) + 3 * v(1, i) - (i == 0 ? 1 : i == 1 ? 2 : 0)));
    const auto x = to_host(model.nodes.position);
    apart.push_back(x(1, 1) - x(0, 1));
  });
  CHECK(worst < 1e-12);
  CHECK_THAT(angular_frequency(apart, model.step_size), WithinRel(std::sqrt(3e3 / 0.75), 1e-3));
}

TEST_CASE("springs and dashpots balance the energy account") {
  scene::Scene scene = ball_scene(2.0, {3e3, 8e3, 2e4}, {0, 0, 0}, 4000);
  scene.connectors[0].axes = oblique_axes();
  scene.connectors[0].preload = {5, -3, 4};
  scene.gravity = {0, 0, -9.81};
  add_motion(scene, {"ball"}, {0.3, 0.2, -0.4});
  for (const Vec3& damping : {Vec3{0, 0, 0}, Vec3{4, 10, 6}}) {
    scene.connectors[0].damping = damping;
    Model model;
    build_model(scene, model);
    set_initial_motion(model, model.nodes, model.beams);
    double first = 0, worst = 0, largest = 0;
    EnergyAccount last;
    march(model, model.step_count, [&] {
      last = account_energies(model, model.step_size);
      if (model.step == 0) first = balance_total(last);
      largest = std::max(largest, largest_energy(last));
      worst = std::max(worst, std::fabs(balance_total(last) - first));
    });
    INFO("worst imbalance / largest energy " << worst / largest << ", dissipated " << last.damping / largest);
    // Undamped, the scheme keeps v(n-1/2).v(n+1/2) m/2 + stored energy exactly; 4000 steps of rounding (2e-16) of a
    // place 3 m away, against swings of centimetres, leave less than 1e-10.
    if (damping[0] == 0)
      CHECK(worst < 1e-10 * largest);
    else
      CHECK(worst < 1e-3 * largest);
    if (damping[0] > 0) CHECK(last.damping > 0.3 * largest);
  }
}

TEST_CASE("a block on a soft spring swings as a mass, whichever set the spring holds") {
  for (const std::string set : {"block", "block.z_min"}) {
    scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-2);
    const double mass = 7800 * 1e-3, stiffness = 7.8e6;
    add_spring(scene, "ground", set, {0, 0, stiffness});
    scene.time.step_scale = 0.5;
    add_motion(scene, {"block"}, {0, 0, 1e-2});
    Model model;
    build_model(scene, model);
    set_initial_motion(model, model.nodes, model.beams);
    std::vector<double> height;
    const auto nodes = all_nodes(model);
    march(model, model.step_count, [&] { height.push_back(mean(model, NodeField::displacement, nodes)[2]); });
    // The block's own compression, E A / L = 2.1e10 N/m, slows the swing by 2e-4 at most.
    CHECK_THAT(angular_frequency(height, model.step_size), WithinRel(std::sqrt(stiffness / mass), 1e-3));
  }
}
