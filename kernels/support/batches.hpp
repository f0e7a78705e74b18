#pragma once

#include <utility>

#include "kernels/support/lanes.hpp"
#include "kernels/support/team.hpp"
#include "kernels/support/vector3.hpp"

namespace railwave {

/// Where a kernel does nothing else, and has too few threads to hide that one waits.
inline constexpr int batch_of_few_threads = on_device ? 8 : 1;

struct WeightedVector {
  double weight;
  Vector3 vector;
};

KOKKOS_INLINE_FUNCTION Vector3 added(const WeightedVector& part, const Vector3& sum) {
  return {{multiply_add(part.weight, part.vector[0], sum[0]), multiply_add(part.weight, part.vector[1], sum[1]),
           multiply_add(part.weight, part.vector[2], sum[2])}};
}

template <class Term, int... j>
KOKKOS_INLINE_FUNCTION Vector3 add_batch(Vector3 sum, int first, int last, const Term& term,
                                         std::integer_sequence<int, j...>) {
  const WeightedVector part[] = {term(first + j < last ? first + j : last - 1)...};
  ((sum = first + j < last ? added(part[j], sum) : sum), ...);
  return sum;
}

/// Adds term(first) ... term(last - 1) to a sum, one after the other. What a batch of them needs from memory is asked
/// for at once: on a GPU few threads work on long sums, and waiting is all that they cost.
/// Multiply-adds are written out, so that the last bit doesn't depend on what a compiler makes of a kernel.
/// @param term a function of a number that gives a WeightedVector, without side effects, and without branches or they
/// are waited for
template <int width, class Term>
KOKKOS_INLINE_FUNCTION Vector3 add_in_batches(Vector3 sum, int first, int last, const Term& term) {
  for (int i = first; i < last; i += width)
    sum = add_batch(sum, i, last, term, std::make_integer_sequence<int, width>());
  return sum;
}

}  // namespace railwave
