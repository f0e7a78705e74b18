#pragma once

#include "model/elements/element_model.hpp"

namespace railwave {

/// What the account adds, of all blocks of a group.
struct BlockTotals {
  static constexpr int values = energies_of_block;
  Array<const double* [energies_of_block]> of;
  KOKKOS_INLINE_FUNCTION void operator()(int p, double* sum) const {
    for (int k = 0; k < values; ++k) sum[k] += of(p, k);
  }
};

}  // namespace railwave
