#pragma once

#include <utility>

#include "kernels/team.hpp"
#include "kernels/vector3.hpp"

namespace railwave {

/// Where a kernel does nothing else, and has too few threads to hide that one waits.
inline constexpr int batch_of_few_threads = on_device ? 8 : 1;

template <class Term, int... j>
KOKKOS_INLINE_FUNCTION Vector3 add_batch(Vector3 sum, int first, int last, const Term& term,
                                         std::integer_sequence<int, j...>) {
  const Vector3 part[] = {term(first + j < last ? first + j : last - 1)...};
  ((sum = first + j < last ? sum + part[j] : sum), ...);
  return sum;
}

/// Adds term(first) ... term(last - 1) to a sum, one after the other. What a batch of them needs from memory is asked
/// for at once: on a GPU few threads work on long sums, and waiting is all that they cost.
/// @param term a function of a number, without side effects, and without branches or they are waited for
template <int width, class Term>
KOKKOS_INLINE_FUNCTION Vector3 add_in_batches(Vector3 sum, int first, int last, const Term& term) {
  for (int i = first; i < last; i += width)
    sum = add_batch(sum, i, last, term, std::make_integer_sequence<int, width>());
  return sum;
}

}  // namespace railwave
