#pragma once

#include "kernels/spaces.hpp"

namespace railwave {

/// Sums `term(i)` (several values an item) in blocks of fixed size and then block by block, so the result is bitwise the
/// same on any number of threads. `Term` has `static constexpr int values` and `void operator()(int, double*) const`,
/// which adds an item's values.
template <class Term>
struct BlockSum {
  static constexpr int block = 256;
  Term term;
  int count;
  Array<double* [Term::values]> partial;

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    double sum[Term::values] = {};
    const int end = (b + 1) * block < count ? (b + 1) * block : count;
    for (int i = b * block; i < end; ++i) term(i, sum);
    for (int k = 0; k < Term::values; ++k) partial(b, k) = sum[k];
  }
};

/// @param result Term::values numbers
template <class Term>
void block_sum(const Term& term, int count, double* result) {
  const int blocks = (count + BlockSum<Term>::block - 1) / BlockSum<Term>::block;
  const auto partial = unset_array<double* [Term::values]>("block sums", blocks);
  Kokkos::parallel_for("block_sum", Range(0, blocks), BlockSum<Term>{term, count, partial});
  const auto host = Kokkos::create_mirror_view(partial);
  Kokkos::deep_copy(host, partial);
  for (int k = 0; k < Term::values; ++k) result[k] = 0;
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < Term::values; ++k) result[k] += host(b, k);
}

}  // namespace railwave
