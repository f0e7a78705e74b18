#pragma once

#include "kernels/team.hpp"
#include "kernels/vector3.hpp"

namespace railwave {

/// Where a kernel does nothing else, and has too few threads to hide that one waits.
inline constexpr int batch_of_few_threads = on_device ? 8 : 1;

/// Adds term(first) ... term(last - 1) to a sum, one after the other. What a batch of them needs from memory is asked for at
/// once: on a GPU few threads work on long sums, and waiting is all that they cost.
/// @param term a function of a number, without side effects
template <int width, class Term>
KOKKOS_INLINE_FUNCTION Vector3 add_in_batches(Vector3 sum, int first, int last, const Term& term) {
  for (int i = first; i < last; i += width) {
    Vector3 part[width];
    for (int j = 0; j < width; ++j) part[j] = term(i + j < last ? i + j : last - 1);
    for (int j = 0; j < width; ++j)
      if (i + j < last) sum = sum + part[j];
  }
  return sum;
}

}  // namespace railwave
