#include "model/elements/element_model.hpp"

#include <algorithm>
#include <cstdlib>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// RAILWAVE_STEP_PARTS, 1 or 2. Else two where the elements take a GPU long enough: all its places for blocks, a
/// quarter of its threads, or twice as many where few tasks could go on meanwhile.
bool wanted_in_parts(const ElementGroup& group, bool chain) {
  if (const char* chosen = std::getenv("RAILWAVE_STEP_PARTS")) return std::atoi(chosen) > 1;
  return on_device && 4 * fills_of_device(group) > (chain ? 1 : 2);
}

/// A second part of less than this would end before what goes on beside it.
constexpr double least_second_part = 0.25;

}  // namespace

ElementParts divide_elements(const std::vector<ElementGroup>& groups, const std::vector<char>& by_tasks, bool chain) {
  const auto largest = std::max_element(
      groups.begin(), groups.end(),
      [](const ElementGroup& one, const ElementGroup& other) { return one.blocks.count < other.blocks.count; });
  // Damping is a launch of its own after all of the group's elements.
  if (largest == groups.end() || largest->damping.active() || !wanted_in_parts(*largest, chain)) return {};
  const ElementBlocks& blocks = largest->blocks;
  const auto node = to_host(blocks.node), count = to_host(blocks.node_count);
  std::vector<int> first, second;
  for (int p = 0; p < blocks.count; ++p) {
    const int* nodes = node.data() + static_cast<std::size_t>(p) * blocks.node_stride;
    const bool any = std::any_of(nodes, nodes + count(p), [&](int n) { return by_tasks[n & ~advance_bit] != 0; });
    (any ? first : second).push_back(p);
  }
  if (first.empty() || static_cast<double>(second.size()) < least_second_part * blocks.count) return {};
  return {static_cast<int>(largest - groups.begin()),
          {to_device("blocks that tasks concern", first), to_device("other blocks", second)}};
}

}  // namespace railwave
