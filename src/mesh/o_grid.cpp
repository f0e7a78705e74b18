#include "mesh/o_grid.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/sections/section.hpp"

namespace railwave {
namespace {

/// How far the core's sides are bulged from straight (0) towards the circle through its corners (1): between, no corner
/// is as flat as it would be at either.
constexpr double bulge = 0.4;

constexpr double core_share = 0.5;  // half diagonal of the core over the radius

double place(int i, int count) { return 2.0 * i / count - 1; }

/// Cells are strongly sheared where the rim's nodes are close together; smoothing spreads the shear over the disc.
void smooth(RingDisc& disc) {
  SectionMesh section;
  for (std::size_t n = 0; n < disc.nodes.size(); ++n) {
    const Point2 p{disc.nodes[n][0], disc.nodes[n][1]};
    if (static_cast<int>(n) < disc.rim)
      section.add_fixed_node(p);
    else
      section.add_node(p);
  }
  for (const auto& cell : disc.cells) {
    SectionQuad quad;
    quad.nodes = cell;
    section.quads.push_back(quad);
  }
  set_ideal_shapes(section, 0);
  smooth_section(section);
  for (std::size_t n = 0; n < disc.nodes.size(); ++n)
    disc.nodes[n] = {section.nodes[n].position.y, section.nodes[n].position.z};
}

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

RingDisc ring_disc(const std::vector<double>& angles, const std::vector<double>& radii) {
  const int rim = static_cast<int>(angles.size()), along = rim / 4, up = rim / 2 - along;
  const auto outline = core_outline(along, up);
  // Angles of the nodes on the core's outline, ascending as those of the rim, and the core's rotation, by which the two
  // agree on average.
  std::vector<double> own(rim), size(rim);
  double turn = 0;
  for (int k = 0; k < rim; ++k) {
    const RoundPoint p = in_round_core(place(outline[k][0], along), place(outline[k][1], up), core_share);
    own[k] = std::atan2(p[1], p[0]);
    size[k] = std::hypot(p[0], p[1]);
    if (k > 0)
      while (own[k] < own[k - 1]) own[k] += 2 * M_PI;
    turn += (angles[k] - own[k]) / rim;
  }
  // So many rings that half way in their cells are about as long as wide.
  const double mean = 0.5 * (1 + core_share);
  const int rings = std::max(2, static_cast<int>(std::lround((1 - 0.9 * core_share) * rim / (2 * M_PI * mean))));

  RingDisc disc;
  disc.rim = rim;
  const auto ring_node = [rim](int ring, int k) { return ring * rim + k % rim; };
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < rim; ++k) {
      const double share = static_cast<double>(ring) / rings;
      const double angle = (1 - share) * angles[k] + share * (own[k] + turn),
                   radius = (1 - share) * radii[k] + share * size[k];
      disc.nodes.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  const int first = static_cast<int>(disc.nodes.size());
  const auto core_node = [first, along](int i, int j) { return first + j * (along + 1) + i; };
  for (int j = 0; j <= up; ++j)
    for (int i = 0; i <= along; ++i) {
      const RoundPoint p = in_round_core(place(i, along), place(j, up), core_share);
      disc.nodes.push_back(
          {p[0] * std::cos(turn) - p[1] * std::sin(turn), p[0] * std::sin(turn) + p[1] * std::cos(turn)});
    }
  const auto inner = [&](int ring, int k) {
    return ring < rings ? ring_node(ring, k) : core_node(outline[k % rim][0], outline[k % rim][1]);
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < rim; ++k)
      disc.cells.push_back({inner(ring, k), inner(ring, k + 1), inner(ring + 1, k + 1), inner(ring + 1, k)});
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < along; ++i)
      disc.cells.push_back({core_node(i, j), core_node(i + 1, j), core_node(i + 1, j + 1), core_node(i, j + 1)});
  smooth(disc);
  return disc;
}

}  // namespace railwave
