#include "model/subcycling.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {

int Subcycling::phase(long step) const {
  int level = 0;
  while (level + 1 < levels && step % (2L << level) == 0) ++level;
  return level;
}

double Subcycling::gain() const {
  double all = 0, updates = 0;
  for (std::size_t l = 0; l < elements.size(); ++l) {
    all += static_cast<double>(elements[l]);
    updates += static_cast<double>(elements[l]) / static_cast<double>(1L << l);
  }
  return updates > 0 ? all / updates : 1;
}

namespace {

/// Level of each node: external forces are evaluated at every step, elements at the steps of their level, and dashpots
/// of non-reflecting ends at their nodes'. Rows of partial forces ascend by level, so a node's first row is of its
/// finest block.
std::vector<std::uint8_t> node_levels(const NodalState& nodal, const NonReflectingEnds& ends) {
  const auto first = to_host(nodal.nodes.first_partial), place = to_host(nodal.nodes.partial_place);
  const auto external = to_host(nodal.nodes.external_row);
  std::vector<std::uint8_t> level(nodal.nodes.count, 0);
  for (int n = 0; n < nodal.nodes.count; ++n)
    if ((external(n) < 0 || (!ends.alone.empty() && ends.alone[n] != 0)) && first(n + 1) > first(n))
      while (place(first(n)) >= nodal.subcycling.node_levels.row_end[level[n]]) ++level[n];
  return level;
}

}  // namespace

void build_subcycling(const std::vector<ElementGroup>& groups, const NonReflectingEnds& ends, NodalState& nodal) {
  Subcycling& subcycling = nodal.subcycling;
  subcycling = {};
  for (const ElementGroup& group : groups) subcycling.levels = std::max(subcycling.levels, group.level + 1);
  if (subcycling.levels == 1) return;
  subcycling.elements.assign(subcycling.levels, 0);
  int rows = 0;
  for (const ElementGroup& group : groups) {
    rows = group.rows_end();
    for (int l = group.level; l < most_levels; ++l) subcycling.node_levels.row_end[l] = rows;
    for (int count : group.element_count) subcycling.elements[group.level] += count;
  }
  const auto level = node_levels(nodal, ends);
  subcycling.node_levels.level = to_device("node levels", level);

  const auto shared = to_host(nodal.shared.nodes);
  const auto level_of = [&](const SharedNode& node) { return level[node.node & ~special_bit]; };
  std::stable_sort(shared.data(), shared.data() + shared.extent(0),
                   [&](const SharedNode& a, const SharedNode& b) { return level_of(a) < level_of(b); });
  Kokkos::deep_copy(nodal.shared.nodes, shared);
  for (int l = 0; l < subcycling.levels; ++l)
    subcycling.shared_end.push_back(static_cast<int>(std::count_if(
        shared.data(), shared.data() + shared.extent(0), [&](const SharedNode& n) { return level_of(n) <= l; })));
}

std::vector<std::string> describe_subcycling(const scene::Scene& scene, const Subcycling& subcycling) {
  if (!scene.solver.subcycling) return {};
  if (subcycling.levels == 1) return {"does not pay here: every element takes every step"};
  std::vector<std::string> lines;
  for (std::size_t l = 0; l < subcycling.elements.size(); ++l)
    if (subcycling.elements[l] > 0)
      lines.push_back(l == 0 ? fmt::format("{} elements at every step", subcycling.elements[l])
                             : fmt::format("{} elements every {} steps", subcycling.elements[l], 1L << l));
  lines.push_back(fmt::format("{:.3g} times fewer element updates; outputs every whole {} steps", subcycling.gain(),
                              subcycling.cycle()));
  return lines;
}

}  // namespace railwave
