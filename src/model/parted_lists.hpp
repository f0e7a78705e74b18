#pragma once

#include <vector>

#include "kernels/support/parted_sums.hpp"

namespace railwave {

/// Lists over whose items a run sums again and again, in parts that do not depend on the number of ranks: each part
/// belongs to one block of elements or to none. A process sums the parts of its own blocks; where a run has several,
/// rank 0 gets the others' sums of parts and adds all of them in the order of parts.
struct PartedLists {
  PartedItems items;
  std::vector<int> first_part;  ///< by list, one more than lists
  std::vector<int> block;       ///< of each part, among the blocks of all groups; -1: of none
  int values = 0;               ///< numbers of a sum
  Array<double*> part_sums;     ///< values after values
  bool whole = true;            ///< this process sums all parts; false: the own ones alone
  Array<int*> own_parts;

  int list_count() const { return static_cast<int>(first_part.size()) - 1; }
  int part_count() const { return static_cast<int>(block.size()); }
};

/// Numbers of a node's sum: kinetic energy, work of gravity.
inline constexpr int values_of_node_parts = 2;
/// Of mean motions: displacement, velocity, acceleration.
inline constexpr int values_of_motion_parts = 9;
/// Of means of elements: stress, strain, plastic strain.
inline constexpr int values_of_element_parts = 13;

/// @param first of each list among all items, one more than lists
/// @param block of each item, among the blocks of all groups; -1: of none
/// @param values numbers of a sum
PartedLists part_lists(const std::vector<int>& first, const std::vector<int>& block, int values);

/// Parts of the blocks that a process has, by block; those of no block where it is rank 0.
std::vector<int> parts_of(const PartedLists& lists, const std::vector<char>& has_block, bool of_rank_0);

/// From now on this process sums these parts alone.
void keep_parts(PartedLists& lists, const std::vector<int>& parts);

}  // namespace railwave
