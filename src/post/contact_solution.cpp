#include "post/contact_solution.hpp"

#include <algorithm>

namespace railwave {
namespace {

double normal_force_of(const ContactSurfaces& surfaces, const std::vector<int>& nodes) {
  double sum = 0;
  for (const int node : nodes) sum += surfaces.touching.pressure[node] * surfaces.state.slave.area[node];
  return sum;
}

}  // namespace

ContactSolution contact_solution(const ContactState& state, const PatchOptions& options) {
  const ContactSurfaces surfaces(state);
  ContactSolution solution;
  solution.whole = contact_patch(surfaces, surfaces.touching.nodes, options);
  std::vector<std::vector<int>> parts = connected_nodes(state.slave, surfaces.around_slave, surfaces.touching);
  std::stable_sort(parts.begin(), parts.end(), [&](const auto& one, const auto& other) {
    return normal_force_of(surfaces, one) > normal_force_of(surfaces, other);
  });
  const auto large = [](const std::vector<int>& nodes) { return nodes.size() >= smallest_patch; };
  const bool any_large = std::any_of(parts.begin(), parts.end(), large);
  for (const std::vector<int>& nodes : parts) {
    const bool stray = !large(nodes) && (any_large || !solution.patches.empty());
    solution.patches.push_back(parts.size() == 1 ? solution.whole : contact_patch(surfaces, nodes, options));
    if (!stray) continue;
    solution.stray_nodes += static_cast<int>(nodes.size());
    solution.stray_force += normal_force_of(surfaces, nodes);
  }
  return solution;
}

}  // namespace railwave
