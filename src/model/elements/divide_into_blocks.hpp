#pragma once

#include <vector>

#include "model/assembly.hpp"

/// Ways to divide elements[begin, end), numbers of an assembly's elements, into blocks that keep to the limits of
/// kernels/elements/element_blocks.hpp: both order the range block by block and append the place where each block
/// begins to `first`.
namespace railwave {

/// By halving, between layers of elements: as good as can be where the elements lie in straight rows.
void halve_into_blocks(const Assembly& assembly, std::vector<int>& elements, int begin, int end,
                       std::vector<int>& first);

/// By growing one block after the other, each time by the element that fits in best: fills blocks also where rows
/// bend, and where element sizes are graded.
void grow_blocks(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first);

}  // namespace railwave
