#pragma once

#include "kernels/support/vector3.hpp"

/// What one item's few parts are shared out among: kernels of few items, each with some parts, wait less for memory
/// where a GPU's neighbouring threads take a part each.
namespace railwave {

inline constexpr int item_lanes = 8;  ///< of VectorLanes

/// All parts of an item one after the other.
struct OneLane {
  template <class Function>
  KOKKOS_INLINE_FUNCTION void each(int parts, const Function& function) const {
    for (int k = 0; k < parts; ++k) function(k);
  }
  template <class Function>
  KOKKOS_INLINE_FUNCTION double sum(int parts, const Function& function) const {
    double total = 0;
    for (int k = 0; k < parts; ++k) total += function(k);
    return total;
  }
  template <class Function>
  KOKKOS_INLINE_FUNCTION Vector3 sum_of_vectors(int parts, const Function& function) const {
    Vector3 total{{0, 0, 0}};
    for (int k = 0; k < parts; ++k) total = total + function(k);
    return total;
  }
  template <class Function>
  KOKKOS_INLINE_FUNCTION void once(const Function& function) const {
    function();
  }
};

/// The lanes of one thread of a team: sums are in an order that depends on nothing but how many lanes there are.
template <class Member>
struct VectorLanes {
  const Member& member;

  template <class Function>
  KOKKOS_INLINE_FUNCTION void each(int parts, const Function& function) const {
    Kokkos::parallel_for(Kokkos::ThreadVectorRange(member, parts), function);
  }
  template <class Function>
  KOKKOS_INLINE_FUNCTION double sum(int parts, const Function& function) const {
    double total = 0;
    Kokkos::parallel_reduce(
        Kokkos::ThreadVectorRange(member, parts), [&](int k, double& so_far) { so_far += function(k); }, total);
    return total;
  }
  template <class Function>
  KOKKOS_INLINE_FUNCTION Vector3 sum_of_vectors(int parts, const Function& function) const {
    // Reductions of scalars alone are the same in all versions of Kokkos. A lane's own part stays in its registers.
    Vector3 own{{0, 0, 0}};
    each(parts, [&](int k) { own = own + function(k); });
    Vector3 total;
    for (int axis = 0; axis < 3; ++axis) {
      double value = 0;
      Kokkos::parallel_reduce(
          Kokkos::ThreadVectorRange(member, item_lanes), [&](int, double& so_far) { so_far += own[axis]; }, value);
      total[axis] = value;
    }
    return total;
  }
  template <class Function>
  KOKKOS_INLINE_FUNCTION void once(const Function& function) const {
    Kokkos::single(Kokkos::PerThread(member), function);
  }
};

}  // namespace railwave
