#pragma once

#include "kernels/support/block_sum.hpp"

namespace railwave {

/// Largest values of several quantities, and which items have them; -1: no item.
template <int Values>
struct Largest {
  double value[Values];
  int place[Values];

  KOKKOS_INLINE_FUNCTION void clear() {
    for (int k = 0; k < Values; ++k) {
      value[k] = -INFINITY;
      place[k] = -1;
    }
  }

  /// What is not a number counts as larger than any. Of equal values the lowest item's is kept.
  KOKKOS_INLINE_FUNCTION void add(int k, double candidate, int item) {
    if (item < 0) return;
    const double ranked = candidate == candidate ? candidate : INFINITY;
    if (place[k] >= 0 && !(ranked > value[k] || (ranked == value[k] && item < place[k]))) return;
    value[k] = ranked;
    place[k] = item;
  }
};

/// `term(i, value)` gives an item's `Term::values` quantities.
template <class Term>
struct BlockLargest {
  Term term;
  int count, blocks;
  Largest<Term::values>* result;

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    Largest<Term::values> largest;
    largest.clear();
    // Threads of a device side by side read what lies side by side; the order does not matter.
    const int stride = on_device ? blocks : 1;
    const int begin = on_device ? b : b * sum_block;
    const int end = on_device || begin + sum_block > count ? count : begin + sum_block;
    for (int i = begin; i < end; i += stride) {
      double value[Term::values];
      term(i, value);
      for (int k = 0; k < Term::values; ++k) largest.add(k, value[k], i);
    }
    result[b] = largest;
  }
};

/// Largest of what blocks have left.
template <int Values>
struct LeftLargest {
  const Largest<Values>* left;
  int count, blocks;
  Largest<Values>* result;

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    Largest<Values> largest;
    largest.clear();
    for (int i = b; i < count; i += blocks)
      for (int k = 0; k < Values; ++k) largest.add(k, left[i].value[k], left[i].place[k]);
    result[b] = largest;
  }
};

}  // namespace railwave
