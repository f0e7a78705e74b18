#include "interface_motion.hpp"

#include <algorithm>

namespace railwave::vehicle {
namespace {

/// The four polynomials of Hermite at s in [0, 1], or their derivatives by s: of the first place, the first velocity
/// times the length, the second place, the second velocity times the length.
std::array<double, 4> hermite(double s, int order) {
  if (order == 0) return {1 + s * s * (2 * s - 3), s * (1 - s) * (1 - s), s * s * (3 - 2 * s), s * s * (s - 1)};
  if (order == 1) return {6 * s * (s - 1), 1 + s * (3 * s - 4), 6 * s * (1 - s), s * (3 * s - 2)};
  return {12 * s - 6, 6 * s - 4, 6 - 12 * s, 6 * s - 2};
}

}  // namespace

Vector MotionPath::at(double time, int order) const {
  Vector value{};
  if (samples_.size() < 2) {
    const InterfaceMotion& only = samples_.front();
    for (int i = 0; i < 3; ++i) {
      if (order == 0) value[i] = only.displacement[i] + (time - only.time) * only.velocity[i];
      if (order == 1) value[i] = only.velocity[i];
    }
    return value;
  }
  auto next = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, time,
                               [](double t, const InterfaceMotion& sample) { return t < sample.time; });
  const InterfaceMotion &from = *(next - 1), &to = *next;
  const double length = to.time - from.time;
  const std::array<double, 4> share = hermite((time - from.time) / length, order);
  double scale = 1;
  for (int k = 0; k < order; ++k) scale /= length;
  for (int i = 0; i < 3; ++i)
    value[i] = scale * (share[0] * from.displacement[i] + share[1] * length * from.velocity[i] +
                        share[2] * to.displacement[i] + share[3] * length * to.velocity[i]);
  return value;
}

}  // namespace railwave::vehicle
