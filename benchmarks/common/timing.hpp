#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "kernels/support/spaces.hpp"

namespace railwave::bench {

/// Wall time of one call, the device's work included.
template <class Work>
double seconds_of(const Work& work) {
  Kokkos::fence();
  const auto start = std::chrono::steady_clock::now();
  work();
  Kokkos::fence();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Several measurements of the same thing. The best is the least disturbed one; the spread tells how far to trust it.
struct Timing {
  std::vector<double> seconds;

  double best() const { return *std::min_element(seconds.begin(), seconds.end()); }
  double median() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
  /// (slowest - fastest) / fastest
  double spread() const { return *std::max_element(seconds.begin(), seconds.end()) / best() - 1; }
};

/// One call to warm up, then `repetitions` timed ones.
template <class Work>
Timing repeat(int repetitions, const Work& work) {
  work();
  Timing timing;
  for (int r = 0; r < repetitions; ++r) timing.seconds.push_back(seconds_of(work));
  return timing;
}

/// How many calls of `work` take about `seconds`, by a growing trial; at least one.
template <class Work>
long calls_in(double seconds, const Work& work) {
  for (long calls = 1;; calls *= 2) {
    const double taken = seconds_of([&] {
      for (long k = 0; k < calls; ++k) work();
    });
    if (taken > 0.1 * seconds || calls > 100000000L)
      return std::max(1L, static_cast<long>(static_cast<double>(calls) * seconds / taken));
  }
}

}  // namespace railwave::bench
