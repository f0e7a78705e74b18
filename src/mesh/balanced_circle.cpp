#include "mesh/body_balance.hpp"

#include <Eigen/LU>
#include <cmath>

namespace railwave {
namespace {

/// From one node to the next, rad.
double angle_after(const std::vector<double>& angles, std::size_t i) {
  return i + 1 < angles.size() ? angles[i + 1] - angles[i] : angles.front() + 2 * M_PI - angles.back();
}

/// First moment of the polygon's area, and its derivatives by the amplitudes A and B where each radius is multiplied by
/// 1 + A cos(angle) + B sin(angle).
struct Moment {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero();
};

Moment moment_of(const std::vector<double>& angles, const std::vector<double>& radii) {
  const std::size_t count = radii.size();
  Moment moment;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t ends[2] = {i, (i + 1) % count};
    Eigen::Vector2d direction[2], corner[2];
    for (int k = 0; k < 2; ++k) {
      direction[k] = Eigen::Vector2d(std::cos(angles[ends[k]]), std::sin(angles[ends[k]]));
      corner[k] = radii[ends[k]] * direction[k];
    }
    // The triangle's area is sin(a) r0 r1 / 2, its centroid a third of the sum of its corners.
    const double weight = std::sin(angle_after(angles, i)) / 6 * radii[ends[0]] * radii[ends[1]];
    moment.value += weight * (corner[0] + corner[1]);
    for (int k = 0; k < 2; ++k) moment.jacobian += weight * (2 * corner[k] + corner[1 - k]) * direction[k].transpose();
  }
  return moment;
}

}  // namespace

std::vector<double> balanced_radii(const std::vector<double>& angles) {
  const std::size_t count = angles.size();
  std::vector<double> lacking(count, 0), width(count, 0), radii;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = angle_after(angles, i), lacks = a * std::log(a / std::sin(a));
    if (a > 1) return std::vector<double>(count, 1);
    for (std::size_t end : {i, (i + 1) % count}) {
      lacking[end] += lacks / 2;
      width[end] += a;
    }
  }
  for (std::size_t i = 0; i < count; ++i) radii.push_back(std::exp(lacking[i] / width[i]));
  for (int iteration = 0; iteration < 4; ++iteration) {  // Newton's method
    const Moment moment = moment_of(angles, radii);
    const Eigen::Vector2d change = moment.jacobian.partialPivLu().solve(-moment.value);
    for (std::size_t i = 0; i < count; ++i)
      radii[i] *= 1 + change[0] * std::cos(angles[i]) + change[1] * std::sin(angles[i]);
  }
  return radii;
}

}  // namespace railwave
