#pragma once

#include "kernels/support/lanes.hpp"

namespace railwave {

/// Isotropic elasticity at finite rotation, free of history: stress from the present place and the reference place, so
/// nothing drifts however long the body rolls.
struct ElasticConstants {
  double lambda;  ///< Pa
  double mu;      ///< Pa
};

/// Almansi strain e = (I - F^-T F^-1)/2 from the gradient H of a displacement u = x - (R X + t), taken along the
/// present coordinates: e = (H + H^T - H^T H)/2, whatever the rigid motion R, t. Taking out a body's own turn keeps H
/// small, and with it the rounding in single precision.
/// @param H H[i][j] = du_i/dx_j
/// @param e result: xx, yy, zz, xy, yz, zx (tensor components)
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION void almansi_strain(const T (&H)[3][3], T (&e)[6]) {
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int c = 0; c < 6; ++c) {
    const int j = row[c], k = column[c];
    e[c] = S(0.5) * ((H[j][k] + H[k][j]) - (H[0][j] * H[0][k] + H[1][j] * H[1][k] + H[2][j] * H[2][k]));
  }
}

/// Logarithmic (Hencky) strain h = -1/2 ln(I - 2 e) of the present configuration by its series in the Almansi strain:
/// h = e + e.e + 4/3 e.e.e + ...; the term left out is below 4/3 |e|^3 (1e-7 at 0.5 % strain).
/// Needs no polar decomposition and is zero to rounding under any rotation.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void hencky_strain(const T (&e)[6], T (&h)[6]) {
  h[0] = e[0] + (e[0] * e[0] + e[3] * e[3] + e[5] * e[5]);
  h[1] = e[1] + (e[3] * e[3] + e[1] * e[1] + e[4] * e[4]);
  h[2] = e[2] + (e[5] * e[5] + e[4] * e[4] + e[2] * e[2]);
  h[3] = e[3] + (e[0] * e[3] + e[3] * e[1] + e[5] * e[4]);
  h[4] = e[4] + (e[3] * e[5] + e[1] * e[4] + e[4] * e[2]);
  h[5] = e[5] + (e[0] * e[5] + e[3] * e[4] + e[5] * e[2]);
}

template <class T>
KOKKOS_FORCEINLINE_FUNCTION T determinant(const T (&G)[3][3]) {
  return G[0][0] * (G[1][1] * G[2][2] - G[1][2] * G[2][1]) - G[0][1] * (G[1][0] * G[2][2] - G[1][2] * G[2][0]) +
         G[0][2] * (G[1][0] * G[2][1] - G[1][1] * G[2][0]);
}

/// Kirchhoff stress lambda tr(h) I + 2 mu h, in Pa; the Cauchy stress is this over J = det F.
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION void kirchhoff_stress(const ElasticConstants& constants, const T (&h)[6], T (&tau)[6]) {
  const T pressure_part = S(constants.lambda) * (h[0] + h[1] + h[2]);
  for (int c = 0; c < 6; ++c) tau[c] = S(2 * constants.mu) * h[c];
  for (int c = 0; c < 3; ++c) tau[c] += pressure_part;
}

/// Energy for each reference volume, h : tau / 2, J/m3.
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION T elastic_energy_density(const T (&h)[6], const T (&tau)[6]) {
  return S(0.5) * (h[0] * tau[0] + h[1] * tau[1] + h[2] * tau[2]) + (h[3] * tau[3] + h[4] * tau[4] + h[5] * tau[5]);
}

/// Elastic without end: nothing is kept from step to step. See kernels/materials/material.hpp.
struct Elastic {
  using Constants = ElasticConstants;
  static constexpr int history_values = 0;

  const Constants* constants;  ///< by row

  template <class S>
  using OfBlock = Constants;

  template <class S, class Turn>
  KOKKOS_FORCEINLINE_FUNCTION Constants of_block(int row, const Turn& /*turn*/) const {
    return constants[row];
  }
  KOKKOS_FORCEINLINE_FUNCTION static ElasticConstants elastic(const Constants& block) { return block; }

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION static void leave_elastic_part(const Constants& /*block*/, int /*batch*/,
                                                             const T (&/*K*/)[3][3], const T (&/*e*/)[6]) {}

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION static void stress(const Constants& block, int /*batch*/, const T (&/*K*/)[3][3],
                                                 const T (&e)[6], T (&tau)[6]) {
    T h[6];
    hencky_strain(e, h);
    kirchhoff_stress<S>(block, h, tau);
  }
};

}  // namespace railwave
