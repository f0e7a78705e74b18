#pragma once

#include <vector>

#include "model/assembly.hpp"

/// Ways to divide elements[begin, end), numbers of an assembly's elements, into patches that keep to the limits of
/// kernels/elements/patches.hpp: both order the range patch by patch and append the place where each patch begins to
/// `first`.
namespace railwave {

/// By halving, between layers of elements: as good as can be where the elements lie in straight rows.
void halve_into_patches(const Assembly& assembly, std::vector<int>& elements, int begin, int end,
                        std::vector<int>& first);

/// By growing one patch after the other, each time by the element that fits in best: fills patches also where rows
/// bend, and where element sizes are graded.
void grow_patches(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first);

}  // namespace railwave
