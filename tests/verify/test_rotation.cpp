#include <catch2/catch_test_macros.hpp>
#include <random>

#include "tests/verify/block.hpp"
#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// A block whose nodes, surface ones too, are moved at random: warped facets everywhere.
Assembly warped_block(int n, double size, unsigned seed) {
  Assembly assembly = assemble(block_scene({size, size, size}, {n, n, n}, 1));
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-0.2 * size / n, 0.2 * size / n);
  for (Vec3& x : assembly.nodes)
    for (double& c : x) c += shift(generator);
  return assembly;
}

Vec3 rotated(const Vec3& x, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), r = 1 / std::sqrt(3.0);  // about (1, 1, 1)
  const Vec3 axis{r, r, r};
  const double along = r * (x[0] + x[1] + x[2]);
  Vec3 turned;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    turned[i] = x[i] * c + (axis[j] * x[k] - axis[k] * x[j]) * s + axis[i] * along * (1 - c);
  }
  return turned;
}

/// Sum over nodes of m x cross v(n+1/2), which the scheme keeps exactly when internal forces have no moment.
Vec3 angular_momentum(const Model& model) {
  const auto x = to_host(model.nodes.position), v = to_host(model.nodes.velocity);
  Vec3 sum{};
  for (int n = 0; n < model.nodes.count; ++n)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      sum[i] += model.mass[n] * (x(n, j) * v(n, k) - x(n, k) * v(n, j));
    }
  return sum;
}

}  // namespace

TEST_CASE("ten turns of a warped block in 1e5 steps leave no stress") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    scene::Scene scene = block_scene({1, 1, 1}, {3, 3, 3}, 1);
    set_hourglass(scene.parts[0], hourglass, 0.1);
    Model model;
    build_model(scene, warped_block(3, 1.0, 5), model);
    StepPlans plans(model);
    Instant instant;
    instant.step = model.step_size;
    const int steps = 100000;
    double largest = 0, force = 0;
    for (int step = 1; step <= steps; ++step) {
      const double angle = 20 * M_PI * step / steps;
      set_position(model, [&](const Vec3& x, int) { return rotated(x, angle); });
      if (step % 1000 != 0) continue;
      set_velocity(model, [&](const Vec3& x, int) {
        const Vec3 y = rotated(x, angle);
        return Vec3{y[2] - y[1], y[0] - y[2], y[1] - y[0]};
      });
      plans.compute_forces(instant, StepKind::sampled);
      largest = std::max(largest, largest_stress(model));
      for (double a : node_field(model, model.ties, NodeField::acceleration, all_nodes(model)).values)
        force = std::max(force, std::fabs(a) * model.mass[0]);
    }
    INFO("largest stress / E " << largest / 210e9 << ", largest nodal force / (E h^2) " << force / (210e9 / 9));
    CHECK(largest < 1e-8 * 210e9);
    CHECK(force < 1e-8 * 210e9 / 9);
  }
}

TEST_CASE("a free body spun up keeps its angular momentum") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {4, 4, 4}, 1);
    set_hourglass(scene.parts[0], hourglass, 0.1);
    scene.time.end = 2e-3;
    Model model;
    build_model(scene, warped_block(4, 0.1, 9), model);
    StepPlans plans(model);
    // Spin up: a torque field for a quarter of the time, by velocities that grow; then free flight.
    Instant instant;
    instant.step = model.step_size;
    set_velocity(model, [](const Vec3& x, int) {
      return Vec3{300 * x[2] - 500 * x[1] + 1, 500 * x[0] - 200 * x[2], 200 * x[1] - 300 * x[0]};
    });
    Vec3 first{};
    double worst = 0, size = 0;
    for (long step = 0; step < 3000; ++step) {
      plans.compute_forces(instant, StepKind::sampled);
      // x at this instant with v half a step later: advance velocities, compare, go on.
      plans.advance(instant);
      const auto x = to_host(model.nodes.position);
      const Vec3 now = angular_momentum(model);
      if (step == 0) {
        first = now;
        for (double c : first) size = std::max(size, std::fabs(c));
      }
      for (int i = 0; i < 3; ++i) worst = std::max(worst, std::fabs(now[i] - first[i]) / size);
    }
    INFO("worst relative change " << worst);
    CHECK(worst < 1e-10);
    CHECK(largest_stress(model) > 1e5);  // it did deform
  }
}
