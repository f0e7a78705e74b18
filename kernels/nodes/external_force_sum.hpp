#pragma once

#include <cstdint>

#include "kernels/support/vector3.hpp"

namespace railwave {

/// A force in whole quanta.
struct FixedForce {
  long long quanta[3];
};

/// Sum of the external and contact forces on the nodes that can feel any, by row. Contact's part is summed in whole
/// quanta by atomic additions of integers: their order does not matter, so a run is bitwise repeatable, and a push and
/// its reaction cancel exactly.
struct ExternalForceSum {
  Array<double* [3]> load;            ///< N, of loads and connectors
  Array<std::uint64_t* [3]> contact;  ///< quanta, two's complement; Kokkos knows 64-bit atomics by this type alone
  double quantum = 1;                 ///< N, a power of two: 2^-57 of a force beyond any that a sound contact bears

  /// Larger forces (and NaN) saturate; 32 such on one node still do not overflow.
  static constexpr double largest = 144115188075855872.0;  // 2^57

  /// A force in quanta, saturated.
  KOKKOS_INLINE_FUNCTION Vector3 in_quanta(const Vector3& force) const {
    Vector3 result;
    for (int i = 0; i < 3; ++i) result[i] = std::fmax(-largest, std::fmin(largest, force[i] * (1 / quantum)));
    return result;
  }
  /// The same in whole quanta.
  KOKKOS_INLINE_FUNCTION static FixedForce fixed(const Vector3& quanta) {
    FixedForce result;
    for (int i = 0; i < 3; ++i) result.quanta[i] = static_cast<long long>(std::rint(quanta[i]));
    return result;
  }

  KOKKOS_INLINE_FUNCTION void add(int r, const FixedForce& force) const {
    for (int i = 0; i < 3; ++i) Kokkos::atomic_add(&contact(r, i), static_cast<std::uint64_t>(force.quanta[i]));
  }
  KOKKOS_INLINE_FUNCTION void subtract(int r, const FixedForce& force) const {
    for (int i = 0; i < 3; ++i) Kokkos::atomic_add(&contact(r, i), static_cast<std::uint64_t>(-force.quanta[i]));
  }

  KOKKOS_INLINE_FUNCTION Vector3 contact_force(int r) const {
    Vector3 force;
    for (int i = 0; i < 3; ++i) force[i] = quantum * static_cast<double>(static_cast<long long>(contact(r, i)));
    return force;
  }
  KOKKOS_INLINE_FUNCTION Vector3 force(int r) const { return row(load, r) + contact_force(r); }

  KOKKOS_INLINE_FUNCTION void clear_contact(int r) const {
    for (int i = 0; i < 3; ++i) contact(r, i) = 0;
  }
};

}  // namespace railwave
