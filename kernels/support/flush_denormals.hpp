#pragma once

#include "kernels/support/team.hpp"
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace railwave {

/// Has this thread take numbers below 1e-38 (single) or 1e-308 (double precision) for zero.
struct FlushDenormals {
  KOKKOS_INLINE_FUNCTION void operator()(const int) const {
#if defined(__SSE2__) && !defined(RAILWAVE_DEVICE_CODE)
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
#endif
  }
};

/// The same on all threads of a host, from now on. Ahead of a wave motion in single precision fades into such numbers,
/// and each operation on one costs an x86 processor a hundred times another; a GPU takes them as any.
inline void flush_denormals() {
  if constexpr (on_device) return;
  Kokkos::parallel_for("flush_denormals", Range(0, ExecutionSpace().concurrency()), FlushDenormals{});
}

}  // namespace railwave
