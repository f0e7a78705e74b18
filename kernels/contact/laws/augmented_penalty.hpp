#pragma once

#include "kernels/contact/contact_arrays.hpp"
#include "kernels/contact/laws/linear_penalty.hpp"

namespace railwave {

/// Contact by augmented Lagrange while a scene settles, for pairs whose run has multipliers: a node presses with
/// max(0, lambda - k gap), lambda being what it pressed with at the last update, so that k need not be large for the
/// gap to vanish. Friction is that of the penalty springs: a node sticks by a spring to where it touched first.
struct AugmentedPenalty : LinearPenalty {
  static constexpr int state_values = 1;
  static constexpr int multiplier = 0;  ///< of the state: lambda, N

  double stiffening;  ///< k over the penalty's stiffness

  KOKKOS_INLINE_FUNCTION double spring(double stiffness) const { return stiffening * stiffness; }
  KOKKOS_INLINE_FUNCTION double pressing(const ContactPoint& point, const double* state) const {
    return state[multiplier] - point.stiffness * point.gap;
  }
  KOKKOS_INLINE_FUNCTION bool touches(const ContactPoint& point, const double* state) const {
    return is_distance(point.gap) && pressing(point, state) > 0;
  }
};

}  // namespace railwave
