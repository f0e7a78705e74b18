#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/elements/element_blocks.hpp"

namespace railwave {

/// Whether a model's elements are put in rows: processors gain by them in double precision.
inline bool wants_rows(bool in_single) { return !on_device && !in_single; }

/// The edge groups of a block (see ElementBlocks::edge), along whichever of its elements' three directions has the
/// fewest.
struct EdgeGroups {
  using Edges = std::array<std::uint8_t, 2 * elements_of_group>;
  std::vector<Edges> node;                            ///< of each: the edges' nodes, those of lower xi first
  std::vector<std::array<std::uint8_t, 4>> of_group;  ///< of each group of elements: those of corners 0 1, 3 2, 4 5 and
                                                      ///< 7 6 of its elements, turned so that xi is the direction
};

/// @param elements of the block by their corners, places among its nodes, in the order of its slots
/// @return none where a block is as fast without, or has a group that is not full
EdgeGroups edge_groups(const std::vector<std::array<int, 8>>& elements);

}  // namespace railwave
