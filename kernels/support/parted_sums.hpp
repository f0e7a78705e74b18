#pragma once

#include "kernels/support/block_sum.hpp"

namespace railwave {

/// Items of lists in parts. The items of a part belong to one block of elements, so that the process which has the
/// block can sum the part alone; its sum does not depend on how blocks are dealt out. A part is summed in chunks, one a
/// thread.
struct PartedItems {
  Array<int*> item;         ///< part after part
  Array<int* [3]> chunks;   ///< of each: its first place in `item`, from one of its places to the next, end of places
  Array<int*> first_chunk;  ///< by part, one more than parts
};

/// Sums `term(item)` over the items of listed chunks. `Term` as BlockSum has it.
template <class Term>
struct ChunkSum {
  Term term;
  PartedItems items;
  Array<const int*> listed;  ///< chunks; empty: all
  double* result;            ///< by chunk

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int c = listed.extent(0) == 0 ? i : listed(i);
    double sum[Term::values] = {};
    for (int k = items.chunks(c, 0); k < items.chunks(c, 2); k += items.chunks(c, 1)) term(items.item(k), sum);
    for (int k = 0; k < Term::values; ++k) result[static_cast<long>(c) * Term::values + k] = sum[k];
  }
};

/// Sums the chunks of listed parts, in their order.
template <int Values>
struct PartSum {
  Array<const int*> first_chunk;
  Array<const int*> listed;  ///< parts; empty: all
  const double* chunk_sums;
  double* result;  ///< by part

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int q = listed.extent(0) == 0 ? i : listed(i);
    double sum[Values] = {};
    for (int c = first_chunk(q); c < first_chunk(q + 1); ++c)
      for (int k = 0; k < Values; ++k) sum[k] += chunk_sums[static_cast<long>(c) * Values + k];
    for (int k = 0; k < Values; ++k) result[static_cast<long>(q) * Values + k] = sum[k];
  }
};

}  // namespace railwave
