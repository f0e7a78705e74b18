#pragma once

#include "kernels/block_sum.hpp"

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
    const double told = candidate == candidate ? candidate : INFINITY;
    if (place[k] >= 0 && !(told > value[k] || (told == value[k] && item < place[k]))) return;
    value[k] = told;
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

/// The largest of each quantity over all items and the item that has it: the same on any number of threads.
template <class Term>
Largest<Term::values> block_largest(const Term& term, int count) {
  using Found = Largest<Term::values>;
  Found largest;
  largest.clear();
  if (count == 0) return largest;
  const int blocks = (count + sum_block - 1) / sum_block, groups = (blocks + sum_block - 1) / sum_block;
  const auto work = unset_array<Found*>("block largest", static_cast<std::size_t>(blocks) + groups);
  Kokkos::parallel_for("block_largest", Range(0, blocks), BlockLargest<Term>{term, count, blocks, work.data()});
  Kokkos::parallel_for("left_largest", Range(0, groups),
                       LeftLargest<Term::values>{work.data(), blocks, groups, work.data() + blocks});
  const auto found = Kokkos::subview(work, Kokkos::make_pair(static_cast<std::size_t>(blocks), static_cast<std::size_t>(blocks + groups)));
  const auto host = Kokkos::create_mirror_view(found);
  Kokkos::deep_copy(host, found);
  for (int g = 0; g < groups; ++g)
    for (int k = 0; k < Term::values; ++k) largest.add(k, host(g).value[k], host(g).place[k]);
  return largest;
}

}  // namespace railwave
