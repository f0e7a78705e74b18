#include <catch2/catch_test_macros.hpp>

#include "kernels/elements/hourglass.hpp"
#include "tests/verify/block.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// Hourglass amplitude of a mode over all elements: the largest |sum_N u_i^N Gamma_M^N| / 8 of displacement.
double amplitude(const Model& model, int direction, int mode) {
  const auto x = to_host(model.nodes.position);
  double largest = 0;
  for (const auto& corners : model.assembly.elements) {
    double sum = 0;
    for (int N = 0; N < 8; ++N)
      sum += mode_sign(3 + mode, N) * (x(corners[N], direction) - model.assembly.nodes[corners[N]][direction]);
    largest = std::max(largest, std::fabs(sum) / 8);
  }
  return largest;
}

/// A field on a block's nodes that is the mode of `Gamma` in every element: products of alternating signs.
double mode_sign(const Vec3& x, double h, int mode) {
  const auto sign = [&](double c) { return std::lround(c / h) % 2 == 0 ? -1.0 : 1.0; };
  const double xi = sign(x[0]), eta = sign(x[1]), zeta = sign(x[2]);
  const double products[4] = {eta * zeta, xi * zeta, xi * eta, xi * eta * zeta};
  return products[mode];
}

}  // namespace

TEST_CASE("each of the twelve hourglass modes of a block decays or stays bounded") {
  const double h = 0.01;
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness})
    for (int direction = 0; direction < 3; ++direction)
      for (int mode = 0; mode < 4; ++mode) {
        scene::Scene scene = block_scene({4 * h, 4 * h, 4 * h}, {4, 4, 4}, 2e-4);
        const bool viscous = hourglass == scene::HourglassType::viscous;
        set_hourglass(scene.parts[0], hourglass, viscous ? 0.1 : 0.05);
        Model model;
        build_model(scene, model);
        const double start = 1e-6;
        set_velocity(model, [&](const Vec3& x, int) {
          Vec3 v{};
          v[direction] = 1e-2 * mode_sign(x, h, mode);
          return v;
        });
        set_position(model, [&](const Vec3& x, int) {
          Vec3 y = x;
          y[direction] += start * mode_sign(x, h, mode);
          return y;
        });
        StepPlans plans(model);
        Instant instant;
        instant.step = model.step_size;
        double largest = 0;
        plans.compute_forces(instant, StepKind::sampled);
        const EnergyAccount before = account_energies(model, model.step_size);
        for (long step = 0; step < model.step_count; ++step) {
          plans.compute_forces(instant, StepKind::sampled);
          plans.advance(instant);
          largest = std::max(largest, amplitude(model, direction, mode));
        }
        plans.compute_forces(instant, StepKind::sampled);
        const EnergyAccount after = account_energies(model, model.step_size);
        INFO("direction " << direction << ", mode " << mode << (viscous ? ", viscous" : ", stiffness")
                          << ": largest amplitude " << largest << ", energy " << balance_total(before) << " -> "
                          << balance_total(after));
        // Uncontrolled, 1e-2 m/s over 2e-4 s would carry the mode to 3e-6.
        CHECK(largest < 1.6e-6);
        if (viscous) CHECK(after.kinetic < 1e-3 * before.kinetic);
        // Stiffness control trades motion for stored energy and back: the sum of both stays.
        if (!viscous) CHECK(std::fabs(balance_total(after) - balance_total(before)) < 1e-3 * balance_total(before));
      }
}

TEST_CASE("hourglass control does nothing to rigid motion and uniform strain") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    std::vector<double> with, without;
    for (double coefficient : {0.1, 0.0}) {
      scene::Scene scene = block_scene({0.04, 0.04, 0.04}, {4, 4, 4}, 1e-4);
      set_hourglass(scene.parts[0], hourglass, coefficient);
      Assembly assembly = assemble(scene);
      for (std::size_t n = 0; n < assembly.nodes.size(); ++n)
        for (int i = 0; i < 3; ++i) assembly.nodes[n][i] += 1e-3 * std::sin(12.9 * n + 3.7 * i);
      Model model;
      build_model(scene, assembly, model);
      set_position(model, [](const Vec3& x, int) {
        return Vec3{x[0] + 1e-3 * x[0] + 2e-3 * x[1] + 0.1, x[1] - 1e-3 * x[2], x[2] + 1e-3 * x[0] - 5e-4 * x[2]};
      });
      set_velocity(model, [](const Vec3& x, int) {
        return Vec3{3 + 20 * x[0] - 7 * x[1], 5 * x[2] + 1, 11 * x[0] - 4 * x[2]};
      });
      compute_forces(model);
      (coefficient > 0 ? with : without) =
          node_field(model, model.ties, NodeField::acceleration, all_nodes(model)).values;
    }
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < with.size(); ++k) {
      worst = std::max(worst, std::fabs(with[k] - without[k]));
      largest = std::max(largest, std::fabs(without[k]));
    }
    INFO("change relative to the largest " << worst / largest);
    CHECK(worst < 1e-12 * largest);
  }
}
