#pragma once

#include "kernels/support/lanes.hpp"

/// The eight corner values of a hexahedron written in its modes: products of the corner signs xi, eta, zeta. The
/// constant mode is left out (nothing in an element depends on it); modes 0 to 2 are linear (xi, eta, zeta), 3 to 6 the
/// hourglass base vectors Gamma_M of Flanagan and Belytschko 1981 (eta zeta, xi zeta, xi eta, xi eta zeta). In modes
/// the mean gradient takes a fifth of the operations that it takes corner by corner, and far fewer values live at once,
/// which is what bounds these kernels on a GPU.
namespace railwave {

/// The sign of a mode at a corner.
KOKKOS_FORCEINLINE_FUNCTION constexpr int mode_sign(int mode, int corner) {
  constexpr int sign[7][8] = {{-1, 1, 1, -1, -1, 1, 1, -1}, {-1, -1, 1, 1, -1, -1, 1, 1}, {-1, -1, -1, -1, 1, 1, 1, 1},
                              {1, 1, -1, -1, -1, -1, 1, 1}, {1, -1, -1, 1, -1, 1, 1, -1}, {1, -1, 1, -1, 1, -1, 1, -1},
                              {-1, 1, -1, 1, 1, -1, 1, -1}};
  return sign[mode][corner];
}

/// m[mode] = sum over corners of u times the mode's sign, from what the corners of each edge along xi have in sum and
/// by how much they differ. Edges: of corners 0 and 1, 3 and 2, 4 and 5, 7 and 6.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void modes_of_edges(const T (&sum)[4], const T (&change)[4], T (&m)[7]) {
  const T bottom = change[0] + change[1], top = change[2] + change[3];
  const T bottom_turn = change[1] - change[0], top_turn = change[3] - change[2];
  const T bottom_eta = sum[1] - sum[0], top_eta = sum[3] - sum[2];
  m[0] = bottom + top;
  m[1] = bottom_eta + top_eta;
  m[2] = (sum[2] + sum[3]) - (sum[0] + sum[1]);
  m[3] = top_eta - bottom_eta;
  m[4] = top - bottom;
  m[5] = bottom_turn + top_turn;
  m[6] = top_turn - bottom_turn;
}

/// m[mode] = sum over corners of u times the mode's sign.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void modes_of(const T (&u)[8], T (&m)[7]) {
  const T sum[4] = {u[0] + u[1], u[2] + u[3], u[4] + u[5], u[6] + u[7]};
  const T change[4] = {u[1] - u[0], u[2] - u[3], u[5] - u[4], u[6] - u[7]};
  modes_of_edges(sum, change, m);
}

/// The values at the corners of each edge along xi (see above) are sum - change and sum + change.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void edges_of(const T (&m)[7], T (&sum)[4], T (&change)[4]) {
  const T xi_below = m[0] - m[4], xi_above = m[0] + m[4], turn_below = m[5] - m[6], turn_above = m[5] + m[6];
  const T eta_below = m[1] - m[3], eta_above = m[1] + m[3];
  change[0] = xi_below - turn_below;
  change[1] = xi_below + turn_below;
  change[2] = xi_above - turn_above;
  change[3] = xi_above + turn_above;
  sum[0] = -(m[2] + eta_below);
  sum[1] = eta_below - m[2];
  sum[2] = m[2] - eta_above;
  sum[3] = m[2] + eta_above;
}

/// f[corner] = sum over modes of m times the mode's sign.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void corners_of(const T (&m)[7], T (&f)[8]) {
  T sum[4], change[4];
  edges_of(m, sum, change);
  constexpr int low[4] = {0, 3, 4, 7}, high[4] = {1, 2, 5, 6};
  for (int k = 0; k < 4; ++k) {
    f[low[k]] = sum[k] - change[k];
    f[high[k]] = sum[k] + change[k];
  }
}

/// Mean gradient of Flanagan and Belytschko 1981, eqs. 16 and 79: B[i] = dV/dx[i], the exact derivative of the
/// trilinear volume, in modes. With a, b, c the linear and p, q, r the first three hourglass modes of the coordinates
/// (over 8), V = 8 ([abc] + ([rbp] + [qpc] + [arq]) / 3), [] the triple product; the fourth does not enter. The mean
/// gradient of a nodal field u over the element, (1/V) sum_k u_k B[j][k], is exact for linear fields on warped
/// elements, so the patch test holds to rounding.
/// @param x modes of the coordinates [direction][mode], m
/// @param B result [direction][mode], m2
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION void mean_gradient(const T (&x)[3][7], T (&B)[3][6]) {
  constexpr S linear = S(1) / 64, warped = S(1) / 192;
  for (int i = 0; i < 3; ++i) {
    const T(&y)[7] = x[(i + 1) % 3];
    const T(&z)[7] = x[(i + 2) % 3];
    const auto cross = [&](int a, int b) { return y[a] * z[b] - z[a] * y[b]; };
    B[i][0] = linear * cross(1, 2) + warped * cross(5, 4);
    B[i][1] = linear * cross(2, 0) + warped * cross(3, 5);
    B[i][2] = linear * cross(0, 1) + warped * cross(4, 3);
    B[i][3] = warped * (cross(5, 1) + cross(2, 4));
    B[i][4] = warped * (cross(3, 2) + cross(0, 5));
    B[i][5] = warped * (cross(1, 3) + cross(4, 0));
  }
}

/// sum over modes of u times B; with B = dV/dx and u = x of the same direction, the volume.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T along(const T (&u)[7], const T (&B)[6]) {
  return (u[0] * B[0] + u[1] * B[1] + u[2] * B[2]) + (u[3] * B[3] + u[4] * B[4] + u[5] * B[5]);
}

}  // namespace railwave
