#pragma once

#include "benchmarks/common/timing.hpp"

namespace railwave::bench {

/// a = b + s c, the triad of McCalpin's STREAM.
struct Triad {
  Array<double*> a;
  Array<const double*> b, c;
  double scale;
  KOKKOS_INLINE_FUNCTION void operator()(const long i) const { a(i) = b(i) + scale * c(i); }
};

/// Memory bandwidth in bytes a second, counted as STREAM does: three arrays of doubles, what a write fetches not
/// counted.
/// @param mebibytes of each array; 128 is above the caches of most sockets
inline double triad_bandwidth(int repetitions, long mebibytes) {
  const long count = mebibytes << 17;
  const auto a = unset_array<double*>("a", count), b = unset_array<double*>("b", count),
             c = unset_array<double*>("c", count);
  Kokkos::deep_copy(a, 0.0);
  Kokkos::deep_copy(b, 1.0);
  Kokkos::deep_copy(c, 2.0);
  using Policy = Kokkos::RangePolicy<ExecutionSpace, Kokkos::IndexType<long>>;
  const Timing timing = repeat(repetitions, [&] {
    Kokkos::parallel_for("triad", Policy(0, count), Triad{a, b, c, 3.0});
  });
  return 3.0 * sizeof(double) * static_cast<double>(count) / timing.best();
}

}  // namespace railwave::bench
