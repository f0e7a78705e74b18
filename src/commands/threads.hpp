#pragma once

#include <Kokkos_Core.hpp>

namespace railwave {

/// Kokkos can use so many threads at most: its tables have a fixed length, which it does not check.
inline constexpr int most_threads = 512;

/// Kokkos for as long as this lives, with as many threads as the user asked for: KOKKOS_NUM_THREADS, else
/// OMP_NUM_THREADS, else one for each processor that this process may use. To be made once, before which no other
/// thread of OpenMP is started. Throws InputError where one of the variables by which users choose threads, their
/// stacks and devices makes no sense or asks for more than can be: Kokkos and OpenMP would ignore it, or crash.
class KokkosScope {
 public:
  KokkosScope();

 private:
  struct Prepared {
    Prepared();
  };
  Prepared prepared_;  ///< before Kokkos
  Kokkos::ScopeGuard kokkos_;
};

}  // namespace railwave
