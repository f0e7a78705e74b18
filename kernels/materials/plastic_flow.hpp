#pragma once

#include <cmath>

#include "kernels/materials/elastic.hpp"
#include "kernels/support/lane_choice.hpp"

/// Von Mises plasticity at finite strain without anything to rotate. F = F_e F_p; what is kept is the plastic Green
/// strain E_p = (F_p^T F_p - I)/2, which lives in the reference configuration: zero at the start, untouched by
/// rotations of the body. Seen from the present configuration it takes its share from the Almansi strain, and what is
/// left is elastic: e = (I - G^T G)/2 - G^T E_p G with G = F^-1, h = -1/2 ln(I - 2 e). The radial return is that of
/// Simo and Hughes 1998, 3.3 and 9.3: in Hencky strain it is the one of small strains. Flow stress
/// and stress are Kirchhoff's, so that the work of the flow is a function of the equivalent plastic strain; Cauchy's
/// differ by J = 1 + tr h, 0.1 % at a yield strain of 0.3 %. Symmetric tensors are six values: xx, yy, zz, xy, yz, zx.
/// S is the number, T the lanes' type.
namespace railwave {

struct BilinearConstants {
  ElasticConstants elastic;
  double yield_stress;  ///< Pa, von Mises, at the first yield
  double hardening;     ///< Pa, slope of flow stress over equivalent plastic strain
};

/// Slope of flow stress over plastic strain, E E_t / (E - E_t), from the two slopes of stress over strain under
/// uniaxial stress.
inline double hardening_modulus(double youngs_modulus, double tangent_modulus) {
  return youngs_modulus * tangent_modulus / (youngs_modulus - tangent_modulus);
}

/// c = a.b of tensors with the same principal axes, whose product is symmetric too.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void coaxial_product(const T (&a)[6], const T (&b)[6], T (&c)[6]) {
  c[0] = a[0] * b[0] + a[3] * b[3] + a[5] * b[5];
  c[1] = a[3] * b[3] + a[1] * b[1] + a[4] * b[4];
  c[2] = a[5] * b[5] + a[4] * b[4] + a[2] * b[2];
  c[3] = a[0] * b[3] + a[3] * b[1] + a[5] * b[4];
  c[4] = a[3] * b[5] + a[1] * b[4] + a[4] * b[2];
  c[5] = a[0] * b[5] + a[3] * b[4] + a[5] * b[2];
}

/// c = (a.b + b.a)/2.
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION void symmetric_product(const T (&a)[6], const T (&b)[6], T (&c)[6]) {
  coaxial_product(a, b, c);
  T d[6];
  coaxial_product(b, a, d);
  for (int k = 3; k < 6; ++k) c[k] = S(0.5) * (c[k] + d[k]);
}

/// r = A^T s A.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void carry(const T (&s)[6], const T (&A)[3][3], T (&r)[6]) {
  T P[3][3];
  for (int j = 0; j < 3; ++j) {
    P[0][j] = s[0] * A[0][j] + s[3] * A[1][j] + s[5] * A[2][j];
    P[1][j] = s[3] * A[0][j] + s[1] * A[1][j] + s[4] * A[2][j];
    P[2][j] = s[5] * A[0][j] + s[4] * A[1][j] + s[2] * A[2][j];
  }
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int c = 0; c < 6; ++c) {
    const int j = row[c], k = column[c];
    r[c] = A[0][j] * P[0][k] + A[1][j] * P[1][k] + A[2][j] * P[2][k];
  }
}

/// F = G^-1.
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION void inverse(const T (&G)[3][3], T (&F)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      F[i][j] = G[a][c] * G[b][d] - G[a][d] * G[b][c];
    }
  const T scale = S(1) / (G[0][0] * F[0][0] + G[0][1] * F[1][0] + G[0][2] * F[2][0]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) F[i][j] *= scale;
}

/// 3/2 s : s of a deviator: the square of its von Mises stress.
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION T mises_square(const T (&s)[6]) {
  return S(1.5) * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) + S(3) * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

/// Deviator of a stress; returns the square of its von Mises stress.
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION T deviator(const T (&tau)[6], T (&s)[6]) {
  const T mean = S(1.0 / 3) * (tau[0] + tau[1] + tau[2]);
  for (int c = 0; c < 3; ++c) {
    s[c] = tau[c] - mean;
    s[3 + c] = tau[3 + c];
  }
  return mises_square<S>(s);
}

template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION T flow_stress(const BilinearConstants& constants, const T& equivalent) {
  return S(constants.yield_stress) + S(constants.hardening) * equivalent;
}

/// Work of the flow up to an equivalent plastic strain, J for each m3 of the reference.
KOKKOS_INLINE_FUNCTION double plastic_work(const BilinearConstants& constants, double equivalent) {
  return (constants.yield_stress + 0.5 * constants.hardening * equivalent) * equivalent;
}

/// Radial return of lanes beyond yield.
/// @param s trial deviator, and `mises_square` its von Mises stress squared; `limit` the flow stress
/// @param tau trial stress, brought back to the yield surface
/// @param flow result: what the Hencky strain lost, (3/2) increment s / q
/// @return increment of the equivalent plastic strain; zero, with no flow, in lanes that do not yield
template <class S, class T, class Mask>
KOKKOS_FORCEINLINE_FUNCTION T radial_return(const BilinearConstants& constants, const Mask& yields, const T (&s)[6],
                                            const T& mises_square, const T& limit, T (&tau)[6], T (&flow)[6]) {
  const double mu = constants.elastic.mu;
  const T mises = choose(yields, square_root(mises_square), T(S(1)));
  const T excess = choose(yields, T(mises - limit), T(S(0)));
  const T increment = S(1 / (3 * mu + constants.hardening)) * excess;
  const T along = S(1.5) * increment / mises;
  for (int c = 0; c < 6; ++c) {
    flow[c] = along * s[c];
    tau[c] -= S(2 * mu) * flow[c];
  }
  return increment;
}

/// What a flow of the Hencky strain adds to the plastic strain. With h = e + e.e and all tensors coaxial, the Almansi
/// strain loses d with (I + 2 e - d) d = flow, so d = flow - m.flow + m.m.flow, m = 2 e - flow: the error is one of the
/// flow, never of the strain itself, so that any number of small steps adds up to what a few large ones give.
/// Without common axes the products are the symmetric ones, for d + e.d + d.e - d.d = flow.
/// The flow keeps the trace of the series' h, not of the exact one; det(I + 2 E_p) is therefore brought back to 1.
/// @param G inverse deformation gradient; e trial Almansi strain, elastic part; plastic E_p before
template <class S, bool Coaxial, class T>
KOKKOS_FORCEINLINE_FUNCTION void plastic_increment(const T (&G)[3][3], const T (&e)[6], const T (&flow)[6],
                                                   const T (&plastic)[6], T (&increment)[6]) {
  T m[6], product[6], d[6], F[3][3];
  for (int c = 0; c < 6; ++c) m[c] = S(2) * e[c] - flow[c];
  if constexpr (Coaxial)
    coaxial_product(m, flow, product);
  else
    symmetric_product<S>(m, flow, product);
  for (int c = 0; c < 6; ++c) d[c] = flow[c] - product[c];
  if constexpr (Coaxial)
    coaxial_product(m, d, product);
  else
    symmetric_product<S>(m, d, product);
  for (int c = 0; c < 6; ++c) d[c] = flow[c] - product[c];
  inverse<S>(G, F);
  carry(d, F, increment);
  T a[6];
  for (int c = 0; c < 6; ++c) a[c] = S(2) * (plastic[c] + increment[c]);
  // det(I + a) - 1 by the invariants of a, a sixth of which each principal value of (I + a)/2 is too large by.
  const T minor = a[1] * a[2] - a[4] * a[4];
  const T excess = (a[0] + a[1] + a[2]) + (a[0] * a[1] + a[0] * a[2] - a[3] * a[3] - a[5] * a[5] + minor) +
                   (a[0] * minor - a[3] * (a[3] * a[2] - a[4] * a[5]) + a[5] * (a[3] * a[4] - a[1] * a[5]));
  const T sixth = S(1.0 / 6) * excess;
  for (int c = 0; c < 6; ++c) increment[c] -= sixth * a[c];
  for (int c = 0; c < 3; ++c) increment[c] -= sixth;
}

}  // namespace railwave
