#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "case/scene_meshes.hpp"
#include "mesh/mesh.hpp"

/// Bodies whose axle is the y axis: wheels, wheelsets, rollers and rings.
namespace railwave {

inline double radius_of(const Vec3& p) { return std::hypot(p[0], p[2]); }

/// How far out nodes of inner circles lie at most, a fraction of the radius: between cells of core_size = 90 mm on a
/// radius of 0.46 m, a = 0.196, so that their sectors have their area, a^2 / 12.
inline constexpr double widest_growth = 0.0033;

/// The lathe's volume of half an axle: cones between the pairs beside the hub, and within it the bore's cylinder.
inline double axle_volume(const scene::WheelsetMesh& w) {
  const double first = 0.5 * w.flange_back_distance + 0.070 + w.web_centre - 0.5 * w.hub_width;
  std::vector<std::array<double, 2>> all = w.axle;
  all.push_back({first, w.bore_radius});
  all.push_back({first + w.hub_width, w.bore_radius});
  std::sort(all.begin(), all.end());
  double volume = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double a = all[i - 1][1], b = all[i][1];
    volume += M_PI / 3 * (a * a + a * b + b * b) * (all[i][0] - all[i - 1][0]);
  }
  return volume;
}

}  // namespace railwave
