#pragma once

#include <cmath>

#include "kernels/support/spaces.hpp"

/// The loop as most programs have it, to compare with: one element at a time, nodal forces summed by atomics, stress
/// stored and advanced by its Jaumann rate, viscous hourglass control; rows of three numbers a node (on a host). Shares
/// no code with kernels/. Flanagan and Belytschko 1981; thesis eqs. 2.8 to 2.12, 2.22.
namespace railwave::bench {

struct Baseline {
  int element_count = 0, node_count = 0;
  double lambda = 0, mu = 0, density = 0, sound_speed = 0, hourglass_coefficient = 0;
  Array<int* [8]> corners;
  Array<double* [6]> stress;                    ///< xx, yy, zz, xy, yz, zx; Pa
  Array<double*[3]> position, velocity, force;  ///< m, m/s half a step before, N
  Array<double*> mass;                          ///< kg

  /// Bytes read and written by a step, counted as step_traffic counts.
  double step_traffic() const {
    const double elements = element_count, nodes = node_count;
    return elements * (32 + 2 * 48) + nodes * (24 + 24 + 2 * 24) + nodes * (8 + 2 * 24 + 2 * 24 + 2 * 24);
  }
};

struct BaselineElements {
  Baseline b;
  double elapsed;  ///< s since the last step, 0 at the first

  KOKKOS_INLINE_FUNCTION void operator()(const int e) const {
    double x[8][3], v[8][3], gradient[8][3];
    for (int N = 0; N < 8; ++N) {
      const int n = b.corners(e, N);
      for (int i = 0; i < 3; ++i) {
        x[N][i] = b.position(n, i);
        v[N][i] = b.velocity(n, i);
      }
    }
    const double volume = volume_gradient(x, gradient), inverse_volume = 1 / volume;

    double L[3][3] = {};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        for (int N = 0; N < 8; ++N) L[i][j] += v[N][i] * gradient[N][j];
        L[i][j] *= inverse_volume;
      }

    // Jaumann rate: sigma' = C : D + W sigma - sigma W.
    double s[3][3], W[3][3], D[3][3];
    for (int i = 0; i < 3; ++i) s[i][i] = b.stress(e, i);
    s[0][1] = s[1][0] = b.stress(e, 3);
    s[1][2] = s[2][1] = b.stress(e, 4);
    s[2][0] = s[0][2] = b.stress(e, 5);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        D[i][j] = 0.5 * (L[i][j] + L[j][i]);
        W[i][j] = 0.5 * (L[i][j] - L[j][i]);
      }
    const double trace = D[0][0] + D[1][1] + D[2][2];
    double rate[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        rate[i][j] = 2 * b.mu * D[i][j] + (i == j ? b.lambda * trace : 0.0);
        for (int k = 0; k < 3; ++k) rate[i][j] += W[i][k] * s[k][j] - s[i][k] * W[k][j];
      }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) s[i][j] += elapsed * rate[i][j];
    for (int i = 0; i < 3; ++i) b.stress(e, i) = s[i][i];
    b.stress(e, 3) = s[0][1];
    b.stress(e, 4) = s[1][2];
    b.stress(e, 5) = s[2][0];

    double f[8][3];
    for (int N = 0; N < 8; ++N)
      for (int i = 0; i < 3; ++i)
        f[N][i] = -(s[i][0] * gradient[N][0] + s[i][1] * gradient[N][1] + s[i][2] * gradient[N][2]);
    resist_hourglass(x, v, gradient, volume, inverse_volume, f);
    for (int N = 0; N < 8; ++N)
      for (int i = 0; i < 3; ++i) Kokkos::atomic_add(&b.force(b.corners(e, N), i), f[N][i]);
  }

  /// dV/dx of the trilinear hexahedron, corner by corner (eqs. 16 and 79 of the paper), and the volume.
  KOKKOS_INLINE_FUNCTION static double volume_gradient(const double (&x)[8][3], double (&gradient)[8][3]) {
    // The paper's formula is for the first corner; the others read the corners in these orders.
    constexpr int order[8][8] = {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, 3, 0, 5, 6, 7, 4}, {2, 3, 0, 1, 6, 7, 4, 5},
                                 {3, 0, 1, 2, 7, 4, 5, 6}, {4, 7, 6, 5, 0, 3, 2, 1}, {5, 4, 7, 6, 1, 0, 3, 2},
                                 {6, 5, 4, 7, 2, 1, 0, 3}, {7, 6, 5, 4, 3, 2, 1, 0}};
    double volume = 0;
    for (int N = 0; N < 8; ++N) {
      const double* p2 = x[order[N][1]];
      const double* p3 = x[order[N][2]];
      const double* p4 = x[order[N][3]];
      const double* p5 = x[order[N][4]];
      const double* p6 = x[order[N][5]];
      const double* p8 = x[order[N][7]];
      for (int i = 0; i < 3; ++i) {
        const int y = (i + 1) % 3, z = (i + 2) % 3;
        gradient[N][i] = (p2[y] * ((p6[z] - p3[z]) - (p4[z] - p5[z])) + p3[y] * (p2[z] - p4[z]) +
                          p4[y] * ((p3[z] - p8[z]) - (p5[z] - p2[z])) + p5[y] * ((p8[z] - p6[z]) - (p2[z] - p4[z])) +
                          p6[y] * (p5[z] - p2[z]) + p8[y] * (p4[z] - p5[z])) *
                         (1.0 / 12.0);
      }
      volume += x[N][0] * gradient[N][0];
    }
    return volume;
  }

  KOKKOS_INLINE_FUNCTION void resist_hourglass(const double (&x)[8][3], const double (&v)[8][3],
                                               const double (&gradient)[8][3], double volume, double inverse_volume,
                                               double (&f)[8][3]) const {
    constexpr double base[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1},
                                   {1, -1, -1, 1, -1, 1, 1, -1},
                                   {1, -1, 1, -1, 1, -1, 1, -1},
                                   {-1, 1, -1, 1, 1, -1, 1, -1}};
    const double length = std::cbrt(volume);
    const double c = 0.25 * b.hourglass_coefficient * b.density * b.sound_speed * length * length;
    for (int M = 0; M < 4; ++M) {
      double shape[8], moment[3] = {}, speed[3] = {};
      for (int i = 0; i < 3; ++i)
        for (int N = 0; N < 8; ++N) moment[i] += x[N][i] * base[M][N];
      for (int N = 0; N < 8; ++N)
        shape[N] = base[M][N] - (gradient[N][0] * moment[0] + gradient[N][1] * moment[1] + gradient[N][2] * moment[2]) *
                                    inverse_volume;
      for (int i = 0; i < 3; ++i) {
        for (int N = 0; N < 8; ++N) speed[i] += v[N][i] * shape[N];
        for (int N = 0; N < 8; ++N) f[N][i] -= c * speed[i] * shape[N];
      }
    }
  }
};

struct BaselineNodes {
  Baseline b;
  double velocity_step, step;

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    for (int i = 0; i < 3; ++i) {
      b.velocity(n, i) += velocity_step * b.force(n, i) / b.mass(n);
      b.position(n, i) += step * b.velocity(n, i);
      b.force(n, i) = 0;
    }
  }
};

/// `count` steps; `taken` is how many were done before (the first moves velocities by half a step only).
inline void baseline_steps(const Baseline& b, double step, long taken, long count) {
  for (long k = taken; k < taken + count; ++k) {
    Kokkos::parallel_for("baseline_elements", Range(0, b.element_count), BaselineElements{b, k == 0 ? 0.0 : step});
    Kokkos::parallel_for("baseline_nodes", Range(0, b.node_count), BaselineNodes{b, k == 0 ? 0.5 * step : step, step});
  }
}

}  // namespace railwave::bench
