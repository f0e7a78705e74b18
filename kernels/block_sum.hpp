#pragma once

#include "kernels/team.hpp"

namespace railwave {

/// Items of a block.
inline constexpr int sum_block = 32;

/// Sums `term(i)` (several values an item) in blocks of fixed size, the blocks' sums in blocks again, and the few that are
/// left on the host, so the result is bitwise the same on any number of threads. `Term` has `static constexpr int values`
/// and `void operator()(int, double*) const`, which adds an item's values.
template <class Term>
struct BlockSum {
  Term term;
  int count, blocks;
  double* result;  ///< block after block

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    double sum[Term::values] = {};
    if constexpr (on_device) {
      // A block is every so many items: threads side by side read what lies side by side.
      for (int i = b; i < count; i += blocks) term(i, sum);
    } else {
      const int end = (b + 1) * sum_block < count ? (b + 1) * sum_block : count;
      for (int i = b * sum_block; i < end; ++i) term(i, sum);
    }
    for (int k = 0; k < Term::values; ++k) result[b * Term::values + k] = sum[k];
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

/// Numbers that a sum of `count` items needs as space.
inline std::size_t block_sum_space(std::size_t count, int values) {
  const std::size_t blocks = (count + sum_block - 1) / sum_block;
  return (blocks + (blocks + sum_block - 1) / sum_block) * values;
}

/// @param result Term::values numbers
/// @param space where to work, if it is large enough; allocated anew otherwise
template <class Term>
void block_sum(const Term& term, int count, double* result, const Array<double*>& space = {}) {
  constexpr int values = Term::values;
  for (int k = 0; k < values; ++k) result[k] = 0;
  if (count == 0) return;
  const std::size_t needed = block_sum_space(count, values);
  const auto work = space.extent(0) >= needed ? space : unset_array<double*>("block sums", needed);
  const int blocks = (count + sum_block - 1) / sum_block, groups = (blocks + sum_block - 1) / sum_block;
  double* const second = work.data() + static_cast<std::size_t>(blocks) * values;
  Kokkos::parallel_for("block_sum", Range(0, blocks), BlockSum<Term>{term, count, blocks, work.data()});
  Kokkos::parallel_for("left_sum", Range(0, groups),
                       BlockSum<LeftSum<values>>{LeftSum<values>{work.data()}, blocks, groups, second});
  const auto sums = Kokkos::subview(work, Kokkos::make_pair(static_cast<std::size_t>(blocks) * values,
                                                            static_cast<std::size_t>(blocks + groups) * values));
  const auto host = Kokkos::create_mirror_view(sums);
  Kokkos::deep_copy(host, sums);
  for (int g = 0; g < groups; ++g)
    for (int k = 0; k < values; ++k) result[k] += host(g * values + k);
}

}  // namespace railwave
