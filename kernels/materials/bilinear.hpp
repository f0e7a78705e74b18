#pragma once

#include "kernels/materials/flow_history.hpp"

namespace railwave {

/// Elastic up to a yield stress, then linear isotropic hardening (kernels/materials/plastic_flow.hpp). A batch in which
/// no element yields now pays for a yield test and for no update.
struct Bilinear : FlowHistory<BilinearConstants, 7> {
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void stress(const OfBlock<S>& block, int batch, const T (&K)[3][3], T (&e)[6],
                                          T (&tau)[6]) const {
    T h[6], s[6];
    leave_elastic_part<S>(block, batch, K, e);
    hencky_strain(e, h);
    kirchhoff_stress<S>(block.constants.elastic, h, tau);
    const T mises_square = deviator<S>(tau, s);
    const T limit = flow_stress<S>(block.constants, T(equivalent<S>(batch)));
    const auto yields = mises_square > limit * limit;
    if (!any_lane(yields)) return;
    T lost[6];
    const T increment = radial_return<S>(block.constants, yields, s, mises_square, limit, tau, lost);
    book_flow<S, true>(block, batch, K, e, yields, lost, increment);
  }

  KOKKOS_INLINE_FUNCTION static double work(const Constants& constants, const double (&history)[history_values]) {
    return plastic_work(constants, history[plastic_strain]);
  }
};

}  // namespace railwave
