#pragma once

#include "kernels/support/team.hpp"

namespace railwave {

/// Items that a thread of a host sums, and such blocks that are taken together.
inline constexpr int sum_block = 32;

/// Sums `term(i)` over each block. `Term` as of sum_by_team().
template <class Term>
struct BlockSum {
  Term term;
  int count;
  double* result;  ///< block after block

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    double sum[Term::values] = {};
    const int end = (b + 1) * sum_block < count ? (b + 1) * sum_block : count;
    for (int i = b * sum_block; i < end; ++i) term(i, sum);
    for (int k = 0; k < Term::values; ++k) result[b * Term::values + k] = sum[k];
  }
};

/// The values of each item as they are. `Term` as of sum_by_team().
template <class Term>
struct EachItem {
  Term term;
  double* result;  ///< item after item

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    double value[Term::values] = {};
    term(i, value);
    for (int k = 0; k < Term::values; ++k) result[i * Term::values + k] = value[k];
  }
};

/// An array's own values.
struct ArraySum {
  static constexpr int values = 1;
  Array<const double*> of;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const { sum[0] += of(i); }
};

/// Adds up what blocks have left, one after the other, as a host does.
struct SumOfLeft {
  const double* left;
  int parts;
  double* result;
  KOKKOS_INLINE_FUNCTION void operator()(int /*one*/) const {
    constexpr int at_once = 32;  // memory is asked for so many before the first is added
    double sum = 0, next[at_once];
    for (int first = 0; first < parts; first += at_once) {
      for (int k = 0; k < at_once; ++k) next[k] = first + k < parts ? left[first + k] : 0;
      for (int k = 0; k < at_once; ++k) sum += next[k];
    }
    *result = sum;
  }
};

/// Sums that blocks have left.
template <int Values>
struct LeftSum {
  static constexpr int values = Values;
  const double* left;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const {
    for (int k = 0; k < Values; ++k) sum[k] += left[i * Values + k];
  }
};

}  // namespace railwave
