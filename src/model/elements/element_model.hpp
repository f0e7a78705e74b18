#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/scene.hpp"
#include "kernels/elements/damping_arrays.hpp"
#include "kernels/elements/element_blocks.hpp"
#include "kernels/materials/material.hpp"
#include "kernels/nodes/nodes.hpp"
#include "kernels/support/team_reduction.hpp"
#include "model/elements/block_order.hpp"
#include "model/elements/relative_coordinates.hpp"
#include "model/parted_lists.hpp"

namespace railwave {

/// Of the account, of a block of elements, J: elastic; stored or dissipated by hourglass control; dissipated by
/// damping; work of plastic flow.
inline constexpr int energies_of_block = 4;
/// The work of flow of a block is summed by so many threads first.
inline constexpr int flow_threads = 16;

/// The elements that one kernel works on: those of all parts with the same kind of material and hourglass control,
/// damped or not.
struct ElementGroup {
  std::string parts;  ///< their names, for the summary
  scene::HourglassType hourglass = scene::HourglassType::viscous;
  int level = 0;  ///< evaluated every 2^level steps; groups ascend by it
  ElementBlocks blocks;
  MaterialArrays material;
  DampingArrays damping;
  RelativeBlocks relative;
  int first_partial = 0;            ///< row of the first block's first node in the partial forces
  std::vector<int> first_element;   ///< of each block, in the assembly's numbering
  std::vector<int> element_count;   ///< of each block
  std::vector<int> part_of_row;     ///< position in the scene's parts of each row of constants
  std::vector<int> owner;           ///< rank that computes each block; empty: there is but this process
  Array<double* [2]> block_energy;  ///< J, elastic and hourglass, of each block: where the account works
  Array<double*> slot_sums;         ///< J, work of flow of every so many slots of each block; empty: nothing flows
  Array<double* [energies_of_block]> block_sums;  ///< J, of each block: what the account adds
  PinnedArray<double* [energies_of_block]> block_sums_fetched;
  bool whole = true;  ///< this process has all blocks; false: the own ones alone
  Array<int*> own_blocks;

  /// Rows of the partial forces up to the group's last.
  int rows_end() const {
    return (damping.active() ? damping.first_partial : first_partial) + blocks.count * blocks.node_stride;
  }
};

/// How often a group's elements would fill the device, all its threads at work.
inline double fills_of_device(const ElementGroup& group) {
  return static_cast<double>(group.blocks.count) * elements_of_block / ExecutionSpace().concurrency();
}

/// The blocks of the largest group in two parts, which a device computes one after the other: first those with nodes
/// that loads, contact, constraints or ties concern, so that all of that goes on beside the elements of the second.
struct ElementParts {
  int group = -1;                   ///< of ElementModel::elements; -1: all is one part
  std::vector<Array<int*>> blocks;  ///< of each part
};

/// @param by_tasks of each node, whether anything but elements concerns it
/// @param chain whether tasks come after the elements that wait for each other: ties, multipliers, prescribed motions
/// @return one part where two would not pay
ElementParts divide_elements(const std::vector<ElementGroup>& groups, const std::vector<char>& by_tasks,
                             bool chain);  // element_parts.cpp

struct ElementHistories;

/// The elements of a model with their materials.
struct ElementModel {
  bool in_single = false;  ///< they are computed in single precision
  bool filled = true;      ///< all blocks have their arrays; false: those that this rank computes, see fill_rest()
  BlockOrder order;
  std::vector<ElementGroup> elements;
  PartedLists node_parts;  ///< one list of all nodes, each with the first block that has it
  std::shared_ptr<ElementHistories> element_histories;  ///< null where no history of stress or strain is written
};

/// Number of each group's first block among the blocks of all groups; and at last that of all blocks.
std::vector<int> first_blocks(const std::vector<ElementGroup>& groups);  // sum_parts.cpp

/// Updates the frames from which single precision measures a group's displacements to where its blocks are now.
/// @param order in which the launch comes
void renew_frames(const NodeArrays& nodes, const ElementGroup& group, const ExecutionSpace& order = ExecutionSpace());

/// Calls `work` with a number of the type in which the elements are computed.
template <class Work>
auto with_element_precision(const ElementModel& elements, const Work& work) {
  return elements.in_single ? work(float{}) : work(double{});
}

}  // namespace railwave
