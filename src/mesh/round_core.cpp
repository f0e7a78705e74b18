#include "mesh/round_core.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {
namespace {

/// How far the core's sides are bulged from straight (0) towards the circle through its corners (1): between, no corner
/// is as flat as it would be at either.
constexpr double bulge = 0.4;

}  // namespace

RoundPoint on_disc(double u, double v, double radius) {
  const bool along_x = std::fabs(u) >= std::fabs(v);
  const double far = along_x ? u : v, near = along_x ? v : u;
  if (far == 0) return {0, 0};
  const double angle = M_PI / 4 * near / far, a = radius * far * std::cos(angle), b = radius * far * std::sin(angle);
  return along_x ? RoundPoint{a, b} : RoundPoint{b, a};
}

RoundPoint in_round_core(double u, double v, double radius) {
  const RoundPoint round = on_disc(u, v, radius);
  const double share = bulge * std::max(std::fabs(u), std::fabs(v)), straight = radius / std::sqrt(2.0);
  return {(1 - share) * straight * u + share * round[0], (1 - share) * straight * v + share * round[1]};
}

std::vector<std::array<int, 2>> core_outline(int along, int up) {
  std::vector<std::array<int, 2>> outline;
  for (int k = 0; k < along; ++k) outline.push_back({k, 0});
  for (int k = 0; k < up; ++k) outline.push_back({along, k});
  for (int k = 0; k < along; ++k) outline.push_back({along - k, up});
  for (int k = 0; k < up; ++k) outline.push_back({0, up - k});
  return outline;
}

}  // namespace railwave
