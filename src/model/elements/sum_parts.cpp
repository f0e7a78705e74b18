#include <algorithm>

#include "model/build_steps.hpp"
#include "model/elements/element_histories.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// The first block that has each node; -1: none has it.
std::vector<int> blocks_of_nodes(const std::vector<ElementGroup>& groups, int node_count) {
  std::vector<int> block_of_node(node_count, -1);
  int block = 0;
  for (const ElementGroup& group : groups) {
    const auto node = to_host(group.blocks.node), count = to_host(group.blocks.node_count);
    for (int p = 0; p < group.blocks.count; ++p, ++block)
      for (int l = 0; l < count(p); ++l)
        if (int& first = block_of_node[node(p * group.blocks.node_stride + l) & ~advance_bit]; first < 0) first = block;
  }
  return block_of_node;
}

/// The block that has each of a list of elements, which ascend.
std::vector<int> blocks_of_elements(const std::vector<ElementGroup>& groups, const std::vector<int>& elements) {
  std::vector<int> block_of_element(elements.size(), -1);
  int block = 0;
  for (const ElementGroup& group : groups)
    for (int p = 0; p < group.blocks.count; ++p, ++block) {
      const int first = group.first_element[p], end = first + group.element_count[p];
      for (auto e = std::lower_bound(elements.begin(), elements.end(), first); e != elements.end() && *e < end; ++e)
        block_of_element[e - elements.begin()] = block;
    }
  return block_of_element;
}

}  // namespace

std::vector<int> first_blocks(const std::vector<ElementGroup>& groups) {
  std::vector<int> first{0};
  for (const ElementGroup& group : groups) first.push_back(first.back() + group.blocks.count);
  return first;
}

void build_sum_parts(int node_count, ElementModel& elements, LoadModel& loads) {
  const std::vector<int> of_node = blocks_of_nodes(elements.elements, node_count);
  elements.node_parts = part_lists({0, node_count}, of_node, values_of_node_parts);
  const auto blocks_of_items = [](const std::vector<int>& items, const std::vector<int>& of) {
    std::vector<int> block;
    for (int item : items) block.push_back(of[item]);
    return block;
  };
  MotionHistories& motions = loads.motion_histories;
  motions.parts = part_lists(motions.first, blocks_of_items(to_vector(motions.node), of_node), values_of_motion_parts);
  if (!elements.element_histories) return;
  ElementHistories& histories = *elements.element_histories;
  histories.parts =
      part_lists(histories.first_of_set,
                 blocks_of_items(to_vector(histories.item), blocks_of_elements(elements.elements, histories.elements)),
                 values_of_element_parts);
}

}  // namespace railwave
