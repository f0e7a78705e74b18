#pragma once

#include <vector>

#include "model/assembly.hpp"

namespace railwave {

/// Puts an assembly's elements and nodes into the order in which the solver works: elements patch by patch (see
/// kernels/elements/patches.hpp), nodes in the order in which the patches first need them, those that several patches
/// share before those of a single one. Parts stay ranges; point masses stay last. Sets, surfaces and ranges follow.
struct PatchOrder {
  std::vector<int> first_element;  ///< of each patch, and the number of elements at the end; no patch spans two parts
  std::vector<int> mesh_number;    ///< of each node: its number before
  std::vector<int> level;          ///< of each patch: its elements' level (see model/subcycling.hpp)
};
/// @param levels of each element; empty: all 0. No patch holds elements of two levels.
PatchOrder order_in_patches(Assembly& assembly, const std::vector<int>& levels = {});

}  // namespace railwave
