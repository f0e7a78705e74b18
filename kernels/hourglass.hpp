#pragma once

#include "kernels/lanes.hpp"

/// Orthogonal hourglass control of Flanagan & Belytschko 1981 (thesis 2.5, eqs. 2.22, with 2.22b as TARGETS mends it).
/// The hourglass shape vectors gamma_M^N = Gamma_M^N - (1/V) B_j^N (sum_K x_j^K Gamma_M^K) are taken in the present
/// configuration, so the forces have no resultant, no moment, and do nothing under linear velocity fields.
namespace railwave {

/// Base vectors Gamma_M^N: products of the corner signs: eta zeta, xi zeta, xi eta, xi eta zeta.
KOKKOS_INLINE_FUNCTION constexpr int hourglass_base(int M, int N) {
  constexpr int base[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1},
                              {1, -1, -1, 1, -1, 1, 1, -1},
                              {1, -1, 1, -1, 1, -1, 1, -1},
                              {-1, 1, -1, 1, 1, -1, 1, -1}};
  return base[M][N];
}

/// g[N] = sum_M q[M] Gamma_M^N, with the sums that corners share made once.
template <class T>
KOKKOS_INLINE_FUNCTION void hourglass_at_corners(const T (&q)[4], T (&g)[8]) {
  const T sum = q[0] + q[1], difference = q[0] - q[1], below = q[2] - q[3], above = q[2] + q[3];
  g[0] = below + sum;
  g[1] = difference - below;
  g[2] = below - sum;
  g[3] = -(difference + below);
  g[4] = above - sum;
  g[5] = -(difference + above);
  g[6] = above + sum;
  g[7] = difference - above;
}

/// m[i][M] = sum_N u[i][N] Gamma_M^N.
template <class T>
KOKKOS_INLINE_FUNCTION void hourglass_moments(const T (&u)[3][8], T (&m)[3][4]) {
  for (int i = 0; i < 3; ++i) {
    // The sums over corners 0, 2 | 1, 3 | 4, 6 | 5, 7 and their like are shared between the four vectors.
    const T bottom_even = u[i][0] + u[i][2], bottom_odd = u[i][1] + u[i][3];
    const T top_even = u[i][4] + u[i][6], top_odd = u[i][5] + u[i][7];
    const T bottom = bottom_even - bottom_odd, top = top_even - top_odd;
    m[i][2] = bottom + top;
    m[i][3] = top - bottom;
    const T d02 = u[i][0] - u[i][2], d13 = u[i][1] - u[i][3];
    const T d46 = u[i][4] - u[i][6], d57 = u[i][5] - u[i][7];
    m[i][0] = (d02 + d13) - (d46 + d57);
    m[i][1] = (d02 - d13) - (d46 - d57);
  }
}

/// Viscous control: q = c sum_N v_i^N gamma_M^N, force on corner N = - q_iM gamma_M^N,
/// c = Q_hg/4 rho C_d V^(2/3) (kg/s, given for each element). Dissipates.
struct ViscousHourglass {
  static constexpr bool needs_velocity = true;
  static constexpr bool needs_reference = false;
  static constexpr bool dissipates = true;

  /// @param xm hourglass moments of the present coordinates; vm of the velocities; L velocity gradient
  template <class T>
  KOKKOS_INLINE_FUNCTION static void generalised_force(const T& c, const T (&xm)[3][4], const T (&vm)[3][4],
                                                       const T (&L)[3][3], T (&q)[3][4], T& rate) {
    rate = T(0.0);
    for (int i = 0; i < 3; ++i)
      for (int M = 0; M < 4; ++M) {
        const T speed = vm[i][M] - (L[i][0] * xm[0][M] + L[i][1] * xm[1][M] + L[i][2] * xm[2][M]);
        q[i][M] = c * speed;
        rate += q[i][M] * speed;
      }
  }
};

/// Stiffness control without history: the hourglass content of the reference coordinates seen from the present
/// configuration, H = sum_N X^N gamma_M^N, is minus the present one turned back, so q = -k G^T H with G = dX/dx.
/// k = kappa (lambda + 2 mu) V^(1/3) / 16 (N/m, given for each element). Stores |H|^2 k/2.
struct StiffnessHourglass {
  static constexpr bool needs_velocity = false;
  static constexpr bool needs_reference = true;
  static constexpr bool dissipates = false;

  template <class T>
  KOKKOS_INLINE_FUNCTION static void generalised_force(const T& k, const T (&xm)[3][4], const T (&Xm)[3][4],
                                                       const T (&G)[3][3], T (&q)[3][4], T& energy) {
    energy = T(0.0);
    for (int M = 0; M < 4; ++M) {
      T H[3];
      for (int i = 0; i < 3; ++i) {
        H[i] = Xm[i][M] - (G[i][0] * xm[0][M] + G[i][1] * xm[1][M] + G[i][2] * xm[2][M]);
        energy += (0.5 * k) * (H[i] * H[i]);
      }
      for (int i = 0; i < 3; ++i) q[i][M] = -k * (G[0][i] * H[0] + G[1][i] * H[1] + G[2][i] * H[2]);
    }
  }
};

}  // namespace railwave
