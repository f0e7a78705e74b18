#pragma once

#include <vector>

#include "kernels/elements/element_blocks.hpp"
#include "model/assembly.hpp"

namespace railwave {

/// Puts an assembly's elements and nodes into the order in which the solver works: elements block by block (see
/// kernels/elements/element_blocks.hpp), nodes in the order in which the blocks first need them, those that several
/// blocks share before those of a single one. Parts stay ranges; point masses stay last. Sets, surfaces and ranges
/// follow.
struct BlockOrder {
  std::vector<int> first_element;  ///< of each block, and the number of elements at the end; no block spans two parts
  std::vector<int> mesh_number;    ///< of each node: its number before
  std::vector<int> level;          ///< of each block: its elements' level (see model/subcycling.hpp)
};
/// @param levels of each element; empty: all 0. No block holds elements of two levels.
/// @param in_rows whether elements are put in rows where there are some, see gather_rows()
BlockOrder order_in_blocks(Assembly& assembly, const std::vector<int>& levels = {}, bool in_rows = false);

/// What a block may have at most.
struct BlockLimits {
  int elements = elements_of_block, nodes = nodes_of_block;
};

/// Divides elements[begin, end), numbers of an assembly's elements, into blocks that keep to the limits of
/// kernels/elements/element_blocks.hpp: orders the range block by block and appends the place where each block begins
/// to `first`. By halving, between layers of elements: as good as can be where the elements lie in straight rows.
void halve_into_blocks(const Assembly& assembly, std::vector<int>& elements, int begin, int end,
                       std::vector<int>& first, const BlockLimits& limits = {});

/// The same by growing one block after the other, each time by the element that fits in best: fills blocks also where
/// rows bend, and where element sizes are graded.
void grow_blocks(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first,
                 const BlockLimits& limits = {});

/// Joins what growing has left in between, blocks of few elements, to fuller ones of several pieces. No element of the
/// range is in a block that begins before first[from].
void join_scraps(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first,
                 std::size_t from, const BlockLimits& limits = {});

/// Takes elements into blocks whose groups of elements share their edges (see ElementBlocks::edge): rows of as many
/// neighbours as a group has, which go on across the faces beside them. Orders the range so that these blocks come
/// first, and appends the place where each begins to `first`.
/// @return where the elements begin that are left over
int gather_rows(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first);

}  // namespace railwave
