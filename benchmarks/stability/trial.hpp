#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "benchmarks/common/loop.hpp"
#include "model/host_copy.hpp"
#include "solve/checkpoint/run_state.hpp"

namespace railwave::bench {

/// The fastest node, m/s, by the velocities that the nodes are moved with (of half a step back: those in the middle of
/// a mode that turns round at every step vanish). Infinite where one is no number.
inline double fastest(const Model& model) {
  const auto velocity = to_host(model.nodes.velocity);
  double largest = 0;
  for (int n = 0; n < model.nodes.count; ++n) {
    const double squared =
        velocity(n, 0) * velocity(n, 0) + velocity(n, 1) * velocity(n, 1) + velocity(n, 2) * velocity(n, 2);
    if (!std::isfinite(squared)) return std::numeric_limits<double>::infinity();
    largest = std::fmax(largest, squared);
  }
  return std::sqrt(largest);
}

/// Twice the kinetic energy, J.
inline double motion(const Model& model) {
  const auto velocity = to_host(model.nodes.velocity);
  double sum = 0;
  for (int n = 0; n < model.nodes.count; ++n)
    for (int i = 0; i < 3; ++i) sum += model.mass[n] * velocity(n, i) * velocity(n, i);
  return sum;
}

/// Random velocities of up to `size` at every node that nothing holds.
inline void shake(Model& model, double size) {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> speed(-size, size);
  const auto velocity = to_host(model.nodes.velocity);
  const auto held = to_host(model.nodes.constraint);
  for (int n = 0; n < model.nodes.count; ++n)
    for (int i = 0; i < 3; ++i) velocity(n, i) = held(n) < 0 ? speed(generator) : 0;
  Kokkos::deep_copy(model.nodes.velocity, velocity);
}

/// Lets a loaded model come to rest in its own equilibrium, hourglass control as in the run: velocities are put to zero
/// at each peak of the kinetic energy, until no node is faster than `enough` at one. @return the fastest at the last
/// peak, m/s
inline double calm(Model& model, double step, double enough, int most_steps) {
  constexpr int between = 10;
  model.step_size = step;
  Loop loop(model);
  double before = 0, peak = 0, last = 0;
  for (int k = 0; k < most_steps; k += between) {
    loop.steps(between - 1);
    double now = 0;
    loop.sampled_step([&] {
      now = motion(model);
      peak = std::fmax(peak, fastest(model));
    });
    if (now >= before) {
      before = now;
      continue;
    }
    Kokkos::deep_copy(model.nodes.velocity, 0.0);
    before = 0;
    last = peak;
    if (peak < enough) break;
    peak = 0;
  }
  Kokkos::deep_copy(model.nodes.velocity, 0.0);
  return last;
}

/// Runs of one model with one step or another, each from the same state and the same small shake.
class Trial {
 public:
  static constexpr double shake_size = 1e-3;  ///< m/s
  static constexpr double growth = 300;  ///< of the fastest node's speed, 90000 of its energy, which counts as blown up
  static constexpr long between_checks = 50;

  explicit Trial(Model& model) : model_(model) {
    shake(model, shake_size);
    save_model_state(model, start_);
  }

  bool blows_up(double step, long steps) {
    restore_model_state(model_, start_);
    model_.step_size = step;
    ++runs;
    Loop loop(model_);
    for (long k = 0; k < steps; k += between_checks) {
      loop.steps(between_checks - 1);
      double now = 0;
      loop.sampled_step([&] { now = fastest(model_); });
      if (!(now < growth * shake_size)) return true;
    }
    return false;
  }

  /// Back to the state before the shake.
  void reset() {
    restore_model_state(model_, start_);
    Kokkos::deep_copy(model_.nodes.velocity, 0.0);
  }

  int runs = 0;

 private:
  Model& model_;
  RunState start_;
};

/// The border as seen: the largest step that was seen to stay calm and the smallest that was seen to blow up, s.
struct Border {
  double calm = 0, wild = 0;
  double calm_in_twice = 0;  ///< largest one seen to stay calm over twice as many steps
};

/// @param guess s, of the border
/// @param width relative, to which it is found
inline Border find_border(Trial& trial, double guess, long steps, double width) {
  Border border;
  double low = (1 - 0.5 * width) * guess, high = (1 + 0.5 * width) * guess, stride = width;
  while (true) {
    if (trial.blows_up(high, steps)) break;
    low = border.calm = high;
    high *= 1 + stride;
    stride = std::fmin(0.2, 2 * stride);
  }
  border.wild = high;
  stride = width;
  while (border.calm == 0) {
    if (!trial.blows_up(low, steps))
      border.calm = low;
    else {
      border.wild = low;
      low *= 1 - stride;
      stride = std::fmin(0.2, 2 * stride);
    }
    if (low < 1e-3 * guess) return border;
  }
  while (border.wild > (1 + width) * border.calm) {
    const double middle = 0.5 * (border.calm + border.wild);
    (trial.blows_up(middle, steps) ? border.wild : border.calm) = middle;
  }
  border.calm_in_twice = border.calm;
  while (trial.blows_up(border.calm_in_twice, 2 * steps)) border.calm_in_twice *= 1 - 0.5 * width;
  return border;
}

}  // namespace railwave::bench
