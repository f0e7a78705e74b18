#include "post/micro_slip.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {
namespace {

constexpr double beside = 0.1;  ///< of a facet's diagonal: farther beside the surface a node is not over it

RelativeMotion motion_at(const ContactSide& slave, int node, const ContactSide& master, const FacetPlace& place) {
  const FacetCorners corners = facet_corners(master, place.facet);
  const Vector normal = facet_normal(corners, place);
  const Vector offset = entry(slave.position, node) - place.interpolate(master, master.position);
  RelativeMotion motion;
  if ((offset - offset.dot(normal) * normal).norm() > beside * (corners[2] - corners[0]).norm()) return motion;
  const Vector relative = entry(slave.velocity, node) - place.interpolate(master, master.velocity);
  motion.known = true;
  motion.parting = relative.dot(normal);
  motion.slip = relative - motion.parting * normal;
  return motion;
}

}  // namespace

std::vector<RelativeMotion> relative_motion(const ContactSide& slave, const std::vector<int>& nodes,
                                            const ContactSide& master, const SurfaceSearch& search) {
  std::vector<RelativeMotion> motions;
  motions.reserve(nodes.size());
  for (const int node : nodes) {
    // A node that touches is within a facet's size of a node of the master.
    const FacetPlace place = search.find(entry(slave.position, node), HUGE_VAL);
    motions.push_back(place.facet < 0 ? RelativeMotion{} : motion_at(slave, node, master, place));
  }
  return motions;
}

SlipRegions slip_regions(const ContactState& state, const std::vector<int>& nodes,
                         const std::vector<double>& micro_slip) {
  const ContactSide& slave = state.slave;
  double largest = 0;
  for (const int node : nodes) largest = std::max(largest, entry(slave.tangential_force, node).norm());
  SlipRegions regions;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int node = nodes[i];
    const double bound = state.friction_at(node) * entry(slave.normal_force, node).norm();
    // Not below: without friction both sides are zero, and the node slips.
    regions.by_force.push_back(bound - entry(slave.tangential_force, node).norm() <= slip_force_tolerance * largest);
    regions.by_velocity.push_back(micro_slip[i] > slip_velocity_tolerance);
    if (!state.slipping.empty()) regions.by_solver.push_back(state.slipping[node] == 2);
  }
  return regions;
}

int count_of(const std::vector<bool>& marks) { return static_cast<int>(std::count(marks.begin(), marks.end(), true)); }

double agreement(const std::vector<bool>& one, const std::vector<bool>& other) {
  if (one.empty() || other.size() != one.size()) return 1;
  int same = 0;
  for (std::size_t i = 0; i < one.size(); ++i) same += one[i] == other[i];
  return static_cast<double>(same) / static_cast<double>(one.size());
}

}  // namespace railwave
