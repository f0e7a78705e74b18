#include "mesh/generators/wheel.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/body_balance.hpp"

namespace railwave {
namespace {

double from_axle(const Vec3& x) { return std::hypot(x[0], x[2]); }

/// Linear ramp inwards along the radius: 0 at `begin` and outside of it, 1 at `end` and inside of it.
double inward_ramp(double radius, double begin, double end) {
  return std::clamp((begin - radius) / (begin - std::min(end, 0.999 * begin)), 0.0, 1.0);
}

/// Radii, less 1, that balance the circles of a coarsening level, by station; 0 at stations without nodes of the level.
std::vector<double> level_growth(const Stations& stations, int level, double radius) {
  const auto& kept = stations.levels[level];
  std::vector<double> angles, growth(stations.position.size(), 0);
  for (int station : kept) angles.push_back(stations.position[station] / radius);
  const auto balanced = balanced_radii(angles);
  for (std::size_t i = 0; i < kept.size(); ++i) growth[kept[i]] = balanced[i] - 1;
  return growth;
}

/// Radius inside of which no node belongs to a finer level than this one, m.
double begin_of_level(const Extrusion& extrusion, const SectionMesh& section, const Stations& stations, int level) {
  const auto& kept = stations.levels[level];
  double least = 1e300;
  for (std::size_t n = 0; n < extrusion.station.size(); ++n) {
    const int node = extrusion.section_node[n];
    const bool finer = node >= 0 ? section.nodes[node].level < level
                                 : !std::binary_search(kept.begin(), kept.end(), extrusion.station[n]);
    if (finer) least = std::min(least, from_axle(extrusion.mesh.nodes[n]));
  }
  return least;
}

/// Volume of the section turned about the axle (Pappus), triangle by triangle.
double turned_volume(const SectionMesh& section) {
  double moment = 0;
  for (const SectionQuad& quad : section.quads)
    for (int i = 1; i < 3; ++i) {
      const Point2 a = section.position(quad.nodes[0]), b = section.position(quad.nodes[i]),
                   c = section.position(quad.nodes[i + 1]);
      moment += cross(b - a, c - a) / 2 * (a.z + b.z + c.z) / 3;
    }
  return 2 * M_PI * std::fabs(moment);
}

}  // namespace

void balance_wheel(Extrusion& extrusion, const SectionMesh& section, const Stations& stations,
                   const scene::WheelMesh& wheel) {
  // The circles of each level get the radii that balance them alone. Within rim and web the radii change linearly from
  // those of one level to those of the next, which keeps the shape of the cells; it keeps the shape of the wheel too,
  // because rim and web have nearly plane sides.
  const double ends[] = {0, wheel.rim_inner_radius, wheel.web_inner_radius};
  const auto tread_lacks = level_growth(stations, 0, wheel.radius);
  const double rim_begin = begin_of_level(extrusion, section, stations, 1);
  std::vector<Vec3>& nodes = extrusion.mesh.nodes;
  std::vector<double> growth(nodes.size(), 0);
  std::vector<double> outer(stations.position.size(), 0);
  for (int level = 1; level < static_cast<int>(stations.levels.size()); ++level) {
    const double begin = begin_of_level(extrusion, section, stations, level);
    const auto own = level_growth(stations, level, wheel.radius);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const int station = extrusion.station[n];
      const double ramp = inward_ramp(from_axle(nodes[n]), begin, ends[level]);
      if (ramp > 0) growth[n] += ramp * (own[station] - outer[station]);
    }
    outer = own;
  }
  // Nodes of the tread stay on their circles. The volume that its chords cut off is added at the inner side of the rim,
  // at the same angles.
  RadialMotion motion;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double radius = from_axle(nodes[n]);
    motion.share.push_back(inward_ramp(radius, rim_begin, wheel.rim_inner_radius) *
                           (1 - inward_ramp(radius, wheel.web_outer_radius, wheel.web_inner_radius)));
    motion.shape.push_back(tread_lacks[extrusion.station[n]]);
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n][0] *= 1 + growth[n];
    nodes[n][2] *= 1 + growth[n];
  }
  balance_body(extrusion.mesh, motion, turned_volume(section));
}

}  // namespace railwave
