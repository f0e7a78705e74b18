#include "mesh/body_balance.hpp"

#include <array>
#include <cmath>

namespace railwave {
namespace {

constexpr double pi = 3.14159265358979323846;

using Point = std::array<double, 2>;

double angle_after(const std::vector<double>& angles, std::size_t i) {
  return i + 1 < angles.size() ? angles[i + 1] - angles[i] : angles.front() + 2 * pi - angles.back();
}

/// First moment of the polygon's area, and how it grows when the radii r grow by r cos(angle), r sin(angle).
struct Moment {
  Point value{0, 0};
  std::array<Point, 2> slope{};
};

Moment moment_of(const std::vector<double>& angles, const std::vector<double>& radii) {
  const std::size_t count = radii.size();
  Moment moment;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t ends[2] = {i, (i + 1) % count};
    const double r[2] = {radii[ends[0]], radii[ends[1]]};
    Point end[2];
    for (int k = 0; k < 2; ++k) end[k] = {std::cos(angles[ends[k]]), std::sin(angles[ends[k]])};
    // The triangle's area is sin(a) r0 r1 / 2, its centre a third of its corners' sum.
    const double weight = std::sin(angle_after(angles, i)) / 6 * r[0] * r[1];
    for (int x = 0; x < 2; ++x) {
      moment.value[x] += weight * (r[0] * end[0][x] + r[1] * end[1][x]);
      for (int k = 0; k < 2; ++k)
        for (int way = 0; way < 2; ++way)
          moment.slope[way][x] += weight * (2 * r[k] * end[k][x] + r[1 - k] * end[1 - k][x]) * end[k][way];
    }
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
  for (int iteration = 0; iteration < 4; ++iteration) {
    const Moment m = moment_of(angles, radii);
    const double det = m.slope[0][0] * m.slope[1][1] - m.slope[1][0] * m.slope[0][1];
    const double along = -(m.value[0] * m.slope[1][1] - m.value[1] * m.slope[1][0]) / det;
    const double across = -(m.slope[0][0] * m.value[1] - m.slope[0][1] * m.value[0]) / det;
    for (std::size_t i = 0; i < count; ++i) radii[i] *= 1 + along * std::cos(angles[i]) + across * std::sin(angles[i]);
  }
  return radii;
}

}  // namespace railwave
