#include <limits>

#include "post/patch_ways.hpp"

namespace railwave {
namespace {

constexpr double wanted_travel = 2;  ///< semi-axes, either way
constexpr double needed_travel = 1;  ///< semi-axes, in all

Vector slope(const std::vector<PatchInstant>& instants, std::size_t first, std::size_t last) {
  double count = 0, mean_time = 0;
  Vector mean_centre = Vector::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    if (!instants[i].touches) continue;
    count += 1;
    mean_time += instants[i].time;
    mean_centre += instants[i].centre;
  }
  mean_time /= count;
  mean_centre /= count;
  double square = 0;
  Vector mixed = Vector::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    if (!instants[i].touches) continue;
    const double since = instants[i].time - mean_time;
    square += since * since;
    mixed += since * (instants[i].centre - mean_centre);
  }
  return mixed / square;
}

}  // namespace

std::vector<Vector> patch_velocity(const std::vector<PatchInstant>& instants) {
  std::vector<Vector> velocities;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    velocities.push_back(Vector::Constant(std::numeric_limits<double>::quiet_NaN()));
    if (!instants[i].touches) continue;
    const auto travel = [&](std::size_t other) {
      return (instants[other].centre - instants[i].centre).norm() / instants[i].semi_axis;
    };
    std::size_t first = i, last = i;
    while (first > 0 && instants[first - 1].touches && travel(first) < wanted_travel) --first;
    while (last + 1 < instants.size() && instants[last + 1].touches && travel(last) < wanted_travel) ++last;
    if (first < last &&
        (instants[last].centre - instants[first].centre).norm() >= needed_travel * instants[i].semi_axis)
      velocities.back() = slope(instants, first, last);
  }
  return velocities;
}

}  // namespace railwave
