#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "benchmarks/common/loop.hpp"
#include "model/fields.hpp"
#include "model/host_copy.hpp"
#include "model/time_step/global_step.hpp"

namespace railwave::bench {

/// The limit of the linearised scheme from the program's own forces: differences of the accelerations to positions, K,
/// and to velocities, C, about the model's present state at rest. Stable while dt^2/4 K + dt/2 C <= M. Of scenes
/// without friction, whose forces depend on nothing but places and velocities.
class ExactLimit {
 public:
  explicit ExactLimit(Model& model) : model_(model), size_(3 * model.nodes.count) {
    const auto position = to_host(model.nodes.position);
    for (int n = 0; n < model.nodes.count; ++n) {
      nodes_.push_back(n);
      for (int i = 0; i < 3; ++i) rest_.push_back(position(n, i));
    }
    viscous_ = std::any_of(model.scene.parts.begin(), model.scene.parts.end(), [](const scene::Part& part) {
      return part.hourglass == scene::HourglassType::viscous && part.hourglass_coefficient > 0;
    });
  }

  /// s
  double operator()(double guess) {
    double low = 0, high = 0, step = guess;
    // The limit of a step that makes the dashpots of C too strong is too short, and the other way round.
    for (int pass = 0; pass < 30; ++pass) {
      const double found = 2 / std::sqrt(largest_eigenvalue(2 / step));
      if (!viscous_) return found;
      (found > step ? low : high) = step;
      if (std::fabs(found / step - 1) < 1e-4) return found;
      step = low > 0 && high > 0 ? 0.5 * (low + high) : 0.5 * (step + found);
    }
    return step;
  }

 private:
  using Values = std::vector<double>;

  /// Of nodes moved from their rest by `shift` times a motion, at `velocity` times it.
  Values accelerations(const Values& motion, double shift, double velocity) {
    auto x = to_host(model_.nodes.position), v = to_host(model_.nodes.velocity);
    for (int n = 0; n < model_.nodes.count; ++n)
      for (int i = 0; i < 3; ++i) {
        x(n, i) = rest_[3 * n + i] + shift * motion[3 * n + i];
        v(n, i) = velocity * motion[3 * n + i];
      }
    Kokkos::deep_copy(model_.nodes.position, x);
    Kokkos::deep_copy(model_.nodes.velocity, v);
    model_.velocity_lag = 0;
    Loop(model_).forces();
    return node_field(model_, model_.ties, NodeField::acceleration, nodes_).values;
  }

  /// M^-1 (K + rate C) q
  Values apply(const Values& q, double rate) {
    double largest = 0;
    for (double value : q) largest = std::fmax(largest, std::fabs(value));
    Values image(q.size(), 0.0);
    const auto add = [&](double shift, double velocity, double factor) {
      const Values plus = accelerations(q, shift, velocity), minus = accelerations(q, -shift, -velocity);
      for (std::size_t k = 0; k < q.size(); ++k) image[k] -= 0.5 * factor * (plus[k] - minus[k]);
    };
    const double shift = displacement / largest, velocity = speed / largest;
    add(shift, 0, 1 / shift);
    if (viscous_) add(0, velocity, rate / velocity);
    return image;
  }

  double inner(const Values& a, const Values& b) const {
    double sum = 0;
    for (int n = 0; n < model_.nodes.count; ++n)
      for (int i = 0; i < 3; ++i) sum += model_.mass[n] * a[3 * n + i] * b[3 * n + i];
    return sum;
  }

  double largest_eigenvalue(double rate) {
    std::mt19937 generator(5);
    std::normal_distribution<double> scatter;
    Values now(size_), before(size_, 0.0);
    for (double& value : now) value = scatter(generator);
    now = apply(now, rate);  // leaves what is held
    const auto divide = [](Values& values, double by) {
      for (double& value : values) value /= by;
    };
    divide(now, std::sqrt(inner(now, now)));
    std::vector<double> diagonal, beside;
    RitzValue ritz;
    for (int k = 0; k < most_iterations; ++k) {
      Values image = apply(now, rate);
      diagonal.push_back(inner(now, image));
      for (int i = 0; i < size_; ++i)
        image[i] -= diagonal.back() * now[i] + (beside.empty() ? 0.0 : beside.back()) * before[i];
      beside.push_back(std::sqrt(inner(image, image)));
      if (beside.back() < 1e-6 * std::fabs(diagonal.front()) || k % 10 == 9) {
        ritz = largest_ritz_value(diagonal, beside);
        if (beside.back() < 1e-6 * std::fabs(diagonal.front()) || ritz.residual < 2e-4 * ritz.value) break;
      }
      divide(image, beside.back());
      before = std::move(now);
      now = std::move(image);
    }
    return ritz.value;
  }

  static constexpr int most_iterations = 200;
  static constexpr double speed = 1e-3;          ///< m/s
  static constexpr double displacement = 1e-10;  ///< m: below any penetration, far above rounding of 1e-18 m

  Model& model_;
  int size_;
  Values rest_;
  std::vector<int> nodes_;
  bool viscous_ = false;
};

}  // namespace railwave::bench
