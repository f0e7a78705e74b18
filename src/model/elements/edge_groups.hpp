#pragma once

#include <array>
#include <vector>

#include "kernels/elements/element_blocks.hpp"

namespace railwave {

/// Whether a model's elements are put in rows: processors gain by them in double precision.
inline bool wants_rows(bool in_single) { return !on_device && !in_single; }

inline constexpr int no_element = -1, element_sides = 6;
/// Sides of an element as turned: xi, eta and zeta from below and above.
inline constexpr int xi_below = 0, xi_above = 1, first_side_across = 2;

/// Elements whose corners are numbered anew, still right-handed, so that neighbours have the same three directions
/// wherever the mesh lets them.
struct TurnedElements {
  std::vector<std::array<int, 8>> corners;
  std::vector<std::array<int, element_sides>> next;  ///< by side the neighbour, if it is turned alike; else no_element
};

/// @param elements by their corners, numbers below `nodes`
/// @param direction 0, 1 or 2: which direction of the first element, or of the first that hangs together with no
/// earlier one, becomes xi
TurnedElements turned_elements(const std::vector<std::array<int, 8>>& elements, int nodes, int direction);

/// The edge groups of a block (see ElementBlocks::edge), along whichever of its elements' three directions has the
/// fewest.
struct EdgeGroups {
  std::vector<std::array<int, 2 * elements_of_group>> node;  ///< of each: the edges' nodes, those of lower xi first
  std::vector<std::array<int, 4>> of_group;  ///< of each group of elements: those of corners 0 1, 3 2, 4 5 and 7 6 of
                                             ///< its elements, turned so that xi is the direction
};

/// @param elements of the block by their corners, places among its `nodes` nodes, in the order of its slots
/// @return none where a block is as fast without, or has a group that is not full
EdgeGroups edge_groups(const std::vector<std::array<int, 8>>& elements, int nodes);

}  // namespace railwave
