#pragma once

#include "kernels/support/team_reduction.hpp"

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

  KOKKOS_INLINE_FUNCTION void join(const Largest& other) {
    for (int k = 0; k < Values; ++k) add(k, other.value[k], other.place[k]);
  }
};

/// The largest of each block of items, found by a team. `term(i, value)` gives an item's `Term::values` quantities. The
/// order of items does not matter.
template <class Term>
struct BlockLargest {
  Term term;
  int count, block;  ///< items of all blocks and of one
  Largest<Term::values>* result;

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    Largest<Term::values> largest;
    largest.clear();
    const int begin = team.league_rank() * block, end = count - begin < block ? count : begin + block;
    // Threads of a device side by side read what lies side by side.
    for (int i = begin + team.team_rank(); i < end; i += team.team_size()) {
      double value[Term::values];
      term(i, value);
      for (int k = 0; k < Term::values; ++k) largest.add(k, value[k], i);
    }
    join_team(team, largest, result[team.league_rank()]);
  }
};

}  // namespace railwave
