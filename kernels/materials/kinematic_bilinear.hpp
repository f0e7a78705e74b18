#pragma once

#include "kernels/materials/flow_history.hpp"

namespace railwave {

struct KinematicConstants : BilinearConstants {
  double isotropic_share;  ///< beta
};

/// Bilinear with a back stress: of the hardening modulus H the share beta widens the yield surface and 1 - beta moves
/// it (Prager 1956; Simo and Hughes 1998, 3.3.1). With xi = s - b and q = sqrt(3/2 xi : xi),
///   q <= sigma_y + beta H e_p,   de_p = (q_trial - limit) / (3 mu + H),   db = 2/3 (1 - beta) H (3/2 de_p xi / q).
/// beta = 1 is Bilinear, which knows nothing of all this.
struct KinematicBilinear : BackStressHistory<KinematicConstants, 13> {
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void stress(const OfBlock<S>& block, int batch, const T (&K)[3][3], T (&e)[6],
                                          T (&tau)[6]) const {
    const Constants& material = block.constants;
    T h[6], xi[6], turned[3][3];
    leave_elastic_part<S>(block, batch, K, e);
    hencky_strain(e, h);
    kirchhoff_stress<S>(material.elastic, h, tau);
    deviator<S>(tau, xi);
    const T flowed = equivalent<S>(batch);
    // As long as nothing has flowed there is no back stress either.
    const bool has_flowed = any_lane(flowed > S(0));
    if (has_flowed) {
      T back[6];
      turn_back<S>(block, K, turned);
      load_back<S>(batch, turned, back);
      for (int c = 0; c < 6; ++c) xi[c] -= back[c];
    }
    const T mises_square = railwave::mises_square<S>(xi);
    const T limit = S(material.yield_stress) + S(material.isotropic_share * material.hardening) * flowed;
    const auto yields = mises_square > limit * limit;
    if (!any_lane(yields)) return;
    T lost[6];
    const T increment = radial_return<S>(material, yields, xi, mises_square, limit, tau, lost);
    book_flow<S, false>(block, batch, K, e, yields, lost, increment);
    if (!has_flowed) turn_back<S>(block, K, turned);
    T moved[6];
    const S modulus = S(2.0 / 3 * (1 - material.isotropic_share) * material.hardening);
    for (int c = 0; c < 6; ++c) moved[c] = modulus * lost[c];
    add_back<S>(batch, turned, moved);
  }

  /// Work of the flow: what isotropic hardening makes of it, and 3 a : a / (4 (1 - beta) H) in the moved surface, which
  /// comes back when the flow is reversed.
  KOKKOS_INLINE_FUNCTION static double work(const Constants& constants, const double (&history)[history_values]) {
    const double equivalent = history[plastic_strain];
    const double isotropic =
        (constants.yield_stress + 0.5 * constants.isotropic_share * constants.hardening * equivalent) * equivalent;
    const double kinematic = (1 - constants.isotropic_share) * constants.hardening;
    if (!(kinematic > 0)) return isotropic;
    double square = 0;
    for (int c = 0; c < 6; ++c) square += (c < 3 ? 1 : 2) * history[back_stress + c] * history[back_stress + c];
    return isotropic + 0.75 * square / kinematic;
  }
};

}  // namespace railwave
