#pragma once

#include "kernels/plastic_flow.hpp"

namespace railwave {

/// Elastic up to a yield stress, then linear isotropic hardening (kernels/plastic_flow.hpp). A batch in which no element
/// has ever yielded pays for one value and a yield test; one in which none yields now, for no update.
struct Bilinear {
  static constexpr int history_values = 7;

  BilinearConstants constants;
  /// Tiled as the kernel's number wants it, 7 values: plastic Green strain (xx, yy, zz, xy, yz, zx) in the reference
  /// configuration, equivalent plastic strain.
  Array<double*> history;
  /// The rigid turn R that a displacement gradient leaves out: u = x - (R X + t).
  double turn[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  /// Stress at the present instant, with the flow that leads to it.
  /// @param H gradient of u along the present coordinates, so that the inverse deformation gradient is R^T (I - H)
  template <class S>
  KOKKOS_INLINE_FUNCTION void kirchhoff_stress(int batch, const Pack<S> (&H)[3][3], Pack<S> (&tau)[6]) const {
    using T = Pack<S>;
    T e[6], h[6], s[6];
    const T equivalent = load_history<S>(value(tiled<S>(batch, history_values, 6)));
    elastic_almansi<S>(batch, H, equivalent, e);
    hencky_strain(e, h);
    railwave::kirchhoff_stress<S>(constants.elastic, h, tau);
    const T mises_square = deviator<S>(tau, s), limit = flow_stress<S>(constants, equivalent);
    const auto yields = mises_square > limit * limit;
    if (!any_lane(yields)) return;

    T flow[6], G[3][3], plastic[6], increment[6];
    const T equivalent_increment = radial_return<S>(constants, yields, s, mises_square, limit, tau, flow);
    inverse_gradient<S>(H, G);
    load_plastic<S>(batch, plastic);
    plastic_increment<S>(G, e, flow, plastic, increment);
    for (int c = 0; c < 6; ++c)
      add_to_history<S>(value(tiled<S>(batch, history_values, c)), choose(yields, increment[c], T(S(0))));
    add_to_history<S>(value(tiled<S>(batch, history_values, 6)), equivalent_increment);
  }

  /// Elastic part of the Hencky strain, with the history as it stands.
  template <class S>
  KOKKOS_INLINE_FUNCTION void elastic_strain(int batch, const Pack<S> (&H)[3][3], Pack<S> (&h)[6]) const {
    Pack<S> e[6];
    elastic_almansi<S>(batch, H, load_history<S>(value(tiled<S>(batch, history_values, 6))), e);
    hencky_strain(e, h);
  }

  /// Dissipated so far for each reference volume by an element whose equivalent plastic strain is given, J/m3.
  KOKKOS_INLINE_FUNCTION double plastic_work(double equivalent) const {
    return (constants.yield_stress + 0.5 * constants.hardening * equivalent) * equivalent;
  }

 private:
  KOKKOS_INLINE_FUNCTION double* value(long at) const { return history.data() + at; }

  template <class S>
  KOKKOS_INLINE_FUNCTION void load_plastic(int batch, Pack<S> (&plastic)[6]) const {
    for (int c = 0; c < 6; ++c) plastic[c] = load_history<S>(value(tiled<S>(batch, history_values, c)));
  }

  template <class S>
  KOKKOS_INLINE_FUNCTION void inverse_gradient(const Pack<S> (&H)[3][3], Pack<S> (&G)[3][3]) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        G[i][j] = S(turn[j][i]) - (S(turn[0][i]) * H[0][j] + S(turn[1][i]) * H[1][j] + S(turn[2][i]) * H[2][j]);
  }

  template <class S>
  KOKKOS_INLINE_FUNCTION void elastic_almansi(int batch, const Pack<S> (&H)[3][3], const Pack<S>& equivalent,
                                              Pack<S> (&e)[6]) const {
    almansi_strain<S>(H, e);
    if (!any_lane(equivalent > S(0))) return;
    Pack<S> G[3][3], plastic[6], share[6];
    inverse_gradient<S>(H, G);
    load_plastic<S>(batch, plastic);
    carry(plastic, G, share);
    for (int c = 0; c < 6; ++c) e[c] -= share[c];
  }
};

}  // namespace railwave
