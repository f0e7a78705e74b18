#pragma once

#include <cmath>

#include "kernels/support/lanes.hpp"

#if defined(__GNUC__) && !defined(__clang__)
// g++ 12 finds uninitialised values in its own AVX-512 square root and conversions.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

/// What a kernel needs to decide lane by lane, for packs and plain numbers alike; and history in double precision under
/// kernels of any.
namespace railwave {

template <class T>
KOKKOS_FORCEINLINE_FUNCTION T square_root(const T& value) {
  using std::sqrt;
  return T(sqrt(value));
}

KOKKOS_FORCEINLINE_FUNCTION bool any_lane(bool condition) { return condition; }

template <class T>
KOKKOS_FORCEINLINE_FUNCTION T choose(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}

#ifdef RAILWAVE_SIMD_LANES
template <class S, class Abi>
bool any_lane(const std::experimental::simd_mask<S, Abi>& condition) {
  return std::experimental::any_of(condition);
}

template <class S, class Abi>
std::experimental::simd<S, Abi> choose(const std::experimental::simd_mask<S, Abi>& condition,
                                       const std::experimental::simd<S, Abi>& yes,
                                       const std::experimental::simd<S, Abi>& no) {
  std::experimental::simd<S, Abi> result = no;
  where(condition, result) = yes;
  return result;
}
#endif

/// A history value of a batch.
template <class S>
KOKKOS_FORCEINLINE_FUNCTION Pack<S> load_history(const double* p) {
#ifdef RAILWAVE_SIMD_LANES
  return Pack<S>(p, std::experimental::element_aligned);
#else
  return static_cast<S>(*p);
#endif
}

/// Adds to it in double precision: what one step adds to a sum over many would be lost in float.
template <class S>
KOKKOS_FORCEINLINE_FUNCTION void add_to_history(double* p, const Pack<S>& increment) {
#ifdef RAILWAVE_SIMD_LANES
  S values[lane_count<S>];
  increment.copy_to(values, std::experimental::element_aligned);
  for (int lane = 0; lane < lane_count<S>; ++lane) p[lane] += static_cast<double>(values[lane]);
#else
  *p += static_cast<double>(increment);
#endif
}

}  // namespace railwave

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
