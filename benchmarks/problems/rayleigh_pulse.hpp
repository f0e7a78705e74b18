#pragma once

#include "benchmarks/problems/problem.hpp"

namespace railwave::bench {

/// Rayleigh's wave on a half-space, in plane strain: its speed from the root of his equation, and the motion of a packet
/// of such waves, which runs along the surface without changing (Lamb's surface pulse).
class RayleighPacket {
 public:
  /// @param wavelength of the packet's middle, m; @param width of its envelope (Gaussian, standard deviation), m
  RayleighPacket(const scene::Material& material, double wavelength, double width) {
    const double shear = std::sqrt(material.shear_modulus() / material.density);
    const double ratio = shear / material.dilatational_speed();
    // (2 - xi^2)^2 = 4 sqrt(1 - xi^2) sqrt(1 - xi^2 ratio^2), xi = speed / shear speed, between 0.8 and 1.
    double low = 0.8, high = 1 - 1e-12;
    for (int halving = 0; halving < 200; ++halving) {
      const double xi = 0.5 * (low + high), square = xi * xi;
      const double value = std::pow(2 - square, 2) - 4 * std::sqrt((1 - square) * (1 - square * ratio * ratio));
      (value < 0 ? low : high) = xi;
    }
    speed = shear * low;
    p_ = std::sqrt(1 - std::pow(low * ratio, 2));
    s_ = std::sqrt(1 - low * low);
    // A sum of waves whose common period is far longer than the packet.
    const double middle = 2 * pi / wavelength, spread = 1 / width;
    const int waves = 41;
    for (int w = 0; w < waves; ++w) {
      const double off = 4 * (2.0 * w / (waves - 1) - 1);  // in standard deviations
      const double k = middle + off * spread;
      if (k < 0.25 * middle) continue;
      numbers_.push_back(k);
      amplitudes_.push_back(std::exp(-0.5 * off * off));
    }
    const double top = std::fabs(vertical(0, 0));
    for (double& a : amplitudes_) a /= top;
  }

  double speed = 0;  ///< m/s

  /// Displacement for a unit vertical one in the packet's middle; @param x along the surface from that middle, @param depth
  Vec3 displacement(double x, double depth) const { return {along(x, depth), 0, -vertical(x, depth)}; }
  /// Its derivative along x; the velocity is -speed times this.
  Vec3 slope(double x, double depth) const {
    Vec3 sum{};
    for (std::size_t w = 0; w < numbers_.size(); ++w) {
      const double k = numbers_[w];
      sum[0] -= amplitudes_[w] * k * profile_along(k, depth) * std::cos(k * x);
      sum[2] -= amplitudes_[w] * k * profile_vertical(k, depth) * std::sin(k * x);
    }
    return sum;
  }

 private:
  double along(double x, double depth) const {
    double sum = 0;
    for (std::size_t w = 0; w < numbers_.size(); ++w)
      sum -= amplitudes_[w] * profile_along(numbers_[w], depth) * std::sin(numbers_[w] * x);
    return sum;
  }
  /// Downwards.
  double vertical(double x, double depth) const {
    double sum = 0;
    for (std::size_t w = 0; w < numbers_.size(); ++w)
      sum -= amplitudes_[w] * profile_vertical(numbers_[w], depth) * std::cos(numbers_[w] * x);
    return sum;
  }
  double profile_along(double k, double depth) const {
    return std::exp(-k * p_ * depth) - 2 * p_ * s_ / (1 + s_ * s_) * std::exp(-k * s_ * depth);
  }
  double profile_vertical(double k, double depth) const {
    return p_ * (std::exp(-k * p_ * depth) - 2 / (1 + s_ * s_) * std::exp(-k * s_ * depth));
  }

  double p_ = 0, s_ = 0;
  std::vector<double> numbers_, amplitudes_;
};

/// A packet of Rayleigh waves of 10 mm runs 20 mm along the top of a block. Error: displacements of the whole block at the
/// end, L2. Detail: the speed, from where the packet's phase on the surface fits best.
inline Outcome rayleigh_pulse(double element_size, const Method& method) {
  const double length = 0.08, depth = 0.05, wavelength = 0.01, travel = 0.02, from = 0.03, amplitude = 1e-6;
  const int along = static_cast<int>(std::lround(length / element_size));
  const int down = static_cast<int>(std::lround(depth / element_size));
  scene::Scene scene = block_scene({length, element_size, depth}, {along, 1, down}, method.choice);
  apply(method, scene);
  hold(scene, "block", {false, true, false});
  const RayleighPacket packet(scene.materials[0], wavelength, 0.8 * wavelength);
  scene.time.end = travel / packet.speed;

  Outcome outcome;
  Model model;
  build_model(scene, model);
  set_position(model, [&](const Vec3& x) {
    const Vec3 u = packet.displacement(x[0] - from, depth - x[2]);
    return Vec3{x[0] + amplitude * u[0], x[1], x[2] + amplitude * u[2]};
  });
  set_velocity(model, [&](const Vec3& x) {
    const Vec3 u = packet.slope(x[0] - from, depth - x[2]);
    return Vec3{-packet.speed * amplitude * u[0], 0, -packet.speed * amplitude * u[2]};
  });
  Loop loop(model);
  outcome.seconds = seconds_of([&] { loop.steps(model.step_count); });
  outcome.elements = model.element_count();
  outcome.steps = model.step_count;
  const double time = static_cast<double>(model.step) * model.step_size;
  const auto at = [&](double speed) {
    return [&, speed](const Vec3& x) {
      const Vec3 u = packet.displacement(x[0] - from - speed * time, depth - x[2]);
      return Vec3{amplitude * u[0], 0, amplitude * u[2]};
    };
  };
  outcome.error = relative_error(model, NodeField::displacement, at(packet.speed));

  // The surface's motion against the packet at other speeds: the best fit by golden section.
  std::vector<int> surface;
  for (int n = 0; n < model.nodes.count; ++n)
    if (model.assembly.nodes[n][2] > depth - 1e-9) surface.push_back(n);
  const auto values = node_field(model, NodeField::displacement, surface).values;
  const auto misfit = [&](double speed) {
    double off = 0;
    for (std::size_t k = 0; k < surface.size(); ++k) {
      const Vec3 u = at(speed)(model.assembly.nodes[surface[k]]);
      off += std::pow(values[3 * k] - u[0], 2) + std::pow(values[3 * k + 2] - u[2], 2);
    }
    return off;
  };
  double low = 0.95 * packet.speed, high = 1.05 * packet.speed;
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  for (int k = 0; k < 40; ++k) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
  }
  outcome.details = {{"speed_error", 0.5 * (low + high) / packet.speed - 1}, {"rayleigh_speed", packet.speed}};
  return outcome;
}

}  // namespace railwave::bench
