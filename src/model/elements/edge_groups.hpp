#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/elements/element_blocks.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// Whether a model's elements are put in rows: processors gain by them in double precision.
inline bool wants_rows(bool in_single) { return !on_device && !in_single; }

inline constexpr int no_element = -1, element_sides = 6;
/// Sides of an element as turned: xi, eta and zeta from below and above.
inline constexpr int xi_below = 0, xi_above = 1, first_side_across = 2;

/// Elements whose corners are numbered anew, still right-handed, so that neighbours have the same three directions
/// wherever the mesh lets them. Elements are places in the list that was given, 25 bytes each.
struct TurnedElements {
  std::vector<std::uint8_t> turn;                    ///< how each is turned, see turned()
  std::vector<std::array<int, element_sides>> next;  ///< by side the neighbour, if it is turned alike; else no_element
};

/// @param mesh corners of all elements
/// @param elements numbers of those to turn; the first, and the first of those that hang together with no earlier one,
/// stay as they are
TurnedElements turned_elements(const std::vector<CornerNodes>& mesh, const std::vector<int>& elements);

/// An element's corners as turned. Turns 0, 1 and 2 make xi, eta and zeta the first direction and keep their order.
CornerNodes turned(const CornerNodes& corners, int turn);

/// The side of an element that is `side` when its direction 0, 1 or 2 is made the first.
inline int side_along(int direction, int side) { return (2 * direction + side) % element_sides; }

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
EdgeGroups edge_groups(const std::vector<CornerNodes>& elements);

}  // namespace railwave
