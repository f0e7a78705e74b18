#include "post/slip_regions.hpp"

#include <algorithm>

namespace railwave {

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
    regions.by_solver.push_back(state.slipping[node] == 2);
  }
  return regions;
}

int count_of(const std::vector<bool>& marks) { return static_cast<int>(std::count(marks.begin(), marks.end(), true)); }

double agreement(const std::vector<bool>& one, const std::vector<bool>& other) {
  if (one.empty()) return 1;
  int same = 0;
  for (std::size_t i = 0; i < one.size(); ++i) same += one[i] == other[i];
  return static_cast<double>(same) / static_cast<double>(one.size());
}

}  // namespace railwave
