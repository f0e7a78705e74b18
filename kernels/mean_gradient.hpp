#pragma once

#include "kernels/lanes.hpp"

namespace railwave {

/// Mean gradient of the 8-node hexahedron, Flanagan & Belytschko 1981, eqs. 16 and 79: B[i][N] = dV/dx[i][N], the exact
/// derivative of the trilinear volume. Mean gradient of a nodal field u over the element is (1/V) sum_N u^N B[i][N];
/// it is exact for linear fields on warped elements, so the patch test holds to rounding.
/// @param x nodal coordinates [direction][corner], m
/// @param B result [direction][corner], m2
template <class T>
KOKKOS_INLINE_FUNCTION void mean_gradient(const T (&x)[3][8], T (&B)[3][8]) {
  // Row N lists the corners in the order in which the formula for corner 0 must read them to give corner N.
  constexpr int turn[8][8] = {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, 3, 0, 5, 6, 7, 4}, {2, 3, 0, 1, 6, 7, 4, 5},
                              {3, 0, 1, 2, 7, 4, 5, 6}, {4, 7, 6, 5, 0, 3, 2, 1}, {5, 4, 7, 6, 1, 0, 3, 2},
                              {6, 5, 4, 7, 2, 1, 0, 3}, {7, 6, 5, 4, 3, 2, 1, 0}};
  for (int i = 0; i < 3; ++i) {
    const T(&y)[8] = x[(i + 1) % 3];
    const T(&z)[8] = x[(i + 2) % 3];
    for (int N = 0; N < 8; ++N) {
      const int a = turn[N][1], b = turn[N][2], c = turn[N][3], d = turn[N][4], e = turn[N][5], g = turn[N][7];
      const T ac = z[a] - z[c], ad = z[a] - z[d], cd = z[c] - z[d];
      B[i][N] = (y[a] * ((z[e] - z[b]) - cd) + y[b] * ac + y[c] * ((z[b] - z[g]) + ad) + y[d] * ((z[g] - z[e]) - ac) -
                 y[e] * ad + y[g] * cd) *
                (1.0 / 12.0);
    }
  }
}

/// Volume from the mean gradient: V = sum_N x[0][N] B[0][N].
template <class T>
KOKKOS_INLINE_FUNCTION T volume_of(const T (&x)[3][8], const T (&B)[3][8]) {
  T volume = x[0][0] * B[0][0];
  for (int N = 1; N < 8; ++N) volume += x[0][N] * B[0][N];
  return volume;
}

/// g[i][j] = mean gradient of u[i] along j.
template <class T>
KOKKOS_INLINE_FUNCTION void gradient_of(const T (&u)[3][8], const T (&B)[3][8], const T& inverse_volume, T (&g)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      T sum = u[i][0] * B[j][0];
      for (int N = 1; N < 8; ++N) sum += u[i][N] * B[j][N];
      g[i][j] = sum * inverse_volume;
    }
}

}  // namespace railwave
