#pragma once

#include <cstddef>

#include "kernels/support/spaces.hpp"

namespace railwave {

/// Where reductions leave what their blocks have found; grows to what is asked of it, so that only the first ones
/// allocate.
struct ReductionSpace {
  Array<double*> blocks;  ///< of the reduction at work
  Array<double*> left;    ///< of all that are queued
  PinnedArray<double*> fetched;
  Array<unsigned char*> terms;  ///< of sums that have a launch together
  PinnedArray<unsigned char*> terms_given;
  std::size_t terms_there = 0;  ///< bytes of these that the device has
};

}  // namespace railwave
