#pragma once

#include "kernels/contact_law.hpp"

namespace railwave {

/// Contact by augmented Lagrange while a scene settles, for pairs whose run has multipliers: a node presses with
/// max(0, lambda - k gap), lambda being what it pressed with at the last update, so that k need not be large for the
/// gap to vanish. Friction is that of the penalty springs: a node sticks by a spring to where it touched first.
struct AugmentedLaw : PlainContactLaw {
  Array<const double*> multiplier;  ///< N, by slave node
  double stiffening;                ///< k over the penalty's stiffness

  AugmentedLaw(const Array<const double*>& multipliers, double times) : multiplier(multipliers), stiffening(times) {}

  KOKKOS_INLINE_FUNCTION double stiffness(const ContactArrays& contact, int segment) const {
    return stiffening * contact.segment_stiffness(segment);
  }
  KOKKOS_INLINE_FUNCTION double pressing(const ContactArrays& /*contact*/, int s, int /*node*/, const Projection& now,
                                         double stiffness) const {
    return multiplier(s) - stiffness * now.gap;
  }
  KOKKOS_INLINE_FUNCTION bool apart(const ContactArrays& contact, int s, const Projection& now) const {
    return !is_distance(now.gap) || !(pressing(contact, s, 0, now, stiffness(contact, now.segment)) > 0);
  }
};

}  // namespace railwave
