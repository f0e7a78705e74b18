#pragma once

#include <cmath>
#include <vector>

#include "case/scene.hpp"

namespace railwave::bench {

/// Rayleigh's wave on a half-space, in plane strain: its speed from the root of his equation, and the motion of a
/// packet of such waves, which runs along the surface without changing (Lamb's surface pulse).
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
    const double middle = 2 * M_PI / wavelength, spread = 1 / width;
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

  /// Displacement for a unit vertical one in the packet's middle; @param x along the surface from that middle, @param
  /// depth
  scene::Vec3 displacement(double x, double depth) const { return {along(x, depth), 0, -vertical(x, depth)}; }
  /// Its derivative along x; the velocity is -speed times this.
  scene::Vec3 slope(double x, double depth) const {
    scene::Vec3 sum{};
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

}  // namespace railwave::bench
