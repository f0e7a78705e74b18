#pragma once

#include <cmath>
#include <random>

#include "solve/statics/settle.hpp"
#include "tests/verify/block.hpp"

/// Driving a model step by step, and what the tests measure on it.
namespace railwave::verify {

/// `steps` steps from the model's present instant; `observe()` is called at every instant, first and last included,
/// when the forces are known.
template <class Observe>
void march(Model& model, long steps, const Observe& observe) {
  StepPlans plans(model);
  Instant instant;
  instant.step = model.step_size;
  for (long k = 0;; ++k) {
    instant.time = model.time = static_cast<double>(model.step) * model.step_size;
    plans.compute_forces(instant, StepKind::sampled);
    observe();
    if (k == steps) return;
    plans.advance(instant);
    instant.elapsed = model.step_size;
  }
}

/// Frequency (rad/s) of a sampled oscillation from its first and last zero crossing, each placed by a straight line.
/// NaN when it crosses fewer than three times.
inline double angular_frequency(const std::vector<double>& values, double interval) {
  double first = 0, last = 0;
  int crossings = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (!(values[k - 1] * values[k] < 0)) continue;
    last = interval * (static_cast<double>(k) - values[k] / (values[k] - values[k - 1]));
    if (crossings++ == 0) first = last;
  }
  return crossings < 3 ? std::nan("") : M_PI * (crossings - 1) / (last - first);
}

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Rows are orthonormal: a turn about no axis in particular.
inline std::array<Vec3, 3> oblique_axes() {
  const Vec3 a = (1 / 7.0) * Vec3{2, 3, 6}, b = (1 / 7.0) * Vec3{3, -6, 2};
  return {a, b, cross(a, b)};
}

/// x in axes `rows`: first axis is carried into rows[0], and so on.
inline Vec3 turned(const std::array<Vec3, 3>& rows, const Vec3& x) {
  return x[0] * rows[0] + x[1] * rows[1] + x[2] * rows[2];
}

/// Moves every node by up to `share` of the block's element size, at random.
inline void warp(Assembly& assembly, double element_size, double share, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-share * element_size, share * element_size);
  for (Vec3& x : assembly.nodes)
    for (double& c : x) c += shift(generator);
}

inline double total_mass(const Model& model) {
  double sum = 0;
  for (double m : model.mass) sum += m;
  return sum;
}

/// Mass-weighted mean of a field over a node set.
inline Vec3 mean(const Model& model, NodeField field, const std::vector<int>& nodes) {
  const auto values = node_field(model, model.ties, field, nodes).values;
  Vec3 sum{};
  double mass = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    mass += model.mass[nodes[k]];
    for (int i = 0; i < 3; ++i) sum[i] += model.mass[nodes[k]] * values[3 * k + i];
  }
  return (1 / mass) * sum;
}

/// Of all components of all nodes; 1e300 if any is no number.
inline double largest_speed(const Model& model) {
  double largest = 0;
  for (double v : node_field(model, model.ties, NodeField::velocity, all_nodes(model)).values)
    largest = std::isfinite(v) ? std::max(largest, std::fabs(v)) : 1e300;
  return largest;
}

inline double largest_stress(const Model& model) {
  double largest = 0;
  for (double s : element_stress(model, model.nodes, all_elements(model)).values)
    largest = std::max(largest, std::fabs(s));
  return largest;
}

/// Settles to the end, never interrupted.
inline SettleReport settle_whole(Model& model) {
  return settle(model, [](const auto&) { return true; });
}

}  // namespace railwave::verify
