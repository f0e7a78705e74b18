#pragma once

#include "kernels/contact/laws/contact_point.hpp"
#include "kernels/contact/laws/falling_friction.hpp"

namespace railwave {

/// The law of most pairs: a linear penalty (thesis eq. 2.26c) and a constant coefficient of friction.
struct LinearPenalty {
  static constexpr int state_values = 0;

  double coefficient;  ///< of friction

  KOKKOS_INLINE_FUNCTION static constexpr bool asks_approach() { return false; }
  KOKKOS_INLINE_FUNCTION double spring(double stiffness) const { return stiffness; }
  KOKKOS_INLINE_FUNCTION bool touches(const ContactPoint& point, const double* /*state*/) const {
    return point.gap < 0;
  }
  KOKKOS_INLINE_FUNCTION double pressing(const ContactPoint& point, double* /*state*/) const {
    return -point.gap * point.stiffness;
  }
  KOKKOS_INLINE_FUNCTION double friction_before(const double* /*state*/) const { return coefficient; }
  KOKKOS_INLINE_FUNCTION double friction(const Sliding& /*sliding*/, double* /*state*/) const { return coefficient; }
  KOKKOS_INLINE_FUNCTION void part(const ContactPoint& /*point*/, double* /*state*/) const {}
  KOKKOS_INLINE_FUNCTION double stored(const ContactPoint& point, double normal_square,
                                       double tangential_square) const {
    return 0.5 * (normal_square + tangential_square) / point.stiffness;
  }
  KOKKOS_INLINE_FUNCTION double dissipated(const double* /*state*/) const { return 0; }
};

}  // namespace railwave
