#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace railwave::vehicle {

using Vector = std::array<double, 3>;  ///< x, y, z

/// Where the interface between wheelset and primary suspension is at an instant, and how fast.
struct InterfaceMotion {
  double time = 0;        ///< s
  Vector displacement{};  ///< m, from the undeformed place
  Vector velocity{};      ///< m/s
};

/// The motion between samples: of each direction the cubic polynomial with their displacements and velocities
/// (Hermite). Before the first and behind the last sample it goes on as these polynomials do.
class MotionPath {
 public:
  MotionPath() = default;
  /// @param samples at least one, at increasing times
  explicit MotionPath(std::vector<InterfaceMotion> samples) : samples_(std::move(samples)) {}

  /// @param order 0: displacement, m; 1: velocity, m/s; 2: acceleration, m/s2
  Vector at(double time, int order) const;

  const std::vector<InterfaceMotion>& samples() const { return samples_; }

 private:
  std::vector<InterfaceMotion> samples_;
};

}  // namespace railwave::vehicle
