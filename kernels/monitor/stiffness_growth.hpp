#pragma once

#include "kernels/elements/element_modes.hpp"
#include "kernels/nodes/nodes.hpp"

namespace railwave {

/// Elements whose deformation the stable step follows.
struct DeformedElements {
  /// By element: the step that it bears by itself undeformed, s, 0 where something else than elements acts on its
  /// nodes; lambda / mu; stiffness_over_mass() undeformed, m; the power of its step over its frequency, 2 where it is
  /// damped, negative where the scene's step is none of its limits (levels of subcycling).
  static constexpr int own_step = 0, lame_ratio = 1, stiffness = 2, power = 3, values = 4;
  int count = 0;
  Array<int* [8]> corners;
  Array<float* [values]> value;
};

/// Largest eigenvalue of a matrix of three real eigenvalues by the traces of it, its square and its cube (Smith,
/// Eigenvalues of a symmetric 3x3 matrix, 1961): q + 2 p cos(phi); where they are nearly equal q + 2 p, which is no
/// less.
KOKKOS_INLINE_FUNCTION double largest_eigenvalue(double t1, double t2, double t3) {
  const double q = t1 / 3, d2 = t2 - t1 * q, p = d2 > 0 ? std::sqrt(d2 / 6) : 0;
  if (!(p > 1e-4 * q)) return q + 2 * p;
  const double third = (t3 - t1 * t2 + 2 * q * q * t1) / (6 * p * p * p);
  return q + 2 * p * std::cos(std::acos(std::fmax(-1.0, std::fmin(third, 1.0))) / 3);
}

/// Highest eigenvalue of the mean-gradient stiffness over mu and 8 / (corner mass), m, as if the corners had the same
/// mass: with Q_ij = 1/V sum_N B_iN B_jN that of 2 D + r s s^T, where D has Q's principal values, s their roots and
/// r = lambda / mu (src/model/time_step/element_frequency.cpp). Its traces follow from those of Q, Q^2, Q^3.
/// @param x modes of the coordinates, m
/// @param r lambda / mu, at least 0
/// @return 0 where the element has no volume
KOKKOS_INLINE_FUNCTION double stiffness_over_mass(const double (&x)[3][7], double r) {
  double B[3][6], Q[3][3];
  mean_gradient<double>(x, B);
  const double volume = along(x[0], B[0]);
  if (!(volume > 0)) return 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double sum = 0;
      for (int k = 0; k < 6; ++k) sum += B[i][k] * B[j][k];
      Q[i][j] = sum / volume;
    }
  double q1 = 0, q2 = 0, q3 = 0;
  for (int i = 0; i < 3; ++i) {
    q1 += Q[i][i];
    for (int j = 0; j < 3; ++j) {
      const double square = Q[i][0] * Q[0][j] + Q[i][1] * Q[1][j] + Q[i][2] * Q[2][j];
      if (i == j) q2 += square;
      q3 += square * Q[j][i];
    }
  }
  return largest_eigenvalue((2 + r) * q1, 4 * (1 + r) * q2 + r * r * q1 * q1,
                            (8 + 12 * r) * q3 + 6 * r * r * q1 * q2 + r * r * r * q1 * q1 * q1);
}

/// By how much the deformation F from places X to x makes the stiffness of an element's strains larger at most:
/// J / s^2 with J = det F and s the least principal stretch, for the mean gradient goes with F^-T and the volume with
/// J. F is that of the middle.
/// @param X, x linear modes of the coordinates, each by direction and mode
/// @return infinity where the element is turned inside out
KOKKOS_INLINE_FUNCTION double stiffness_growth(const double (&X)[3][3], const double (&x)[3][3]) {
  const auto minor = [](const double(&m)[3][3], int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const auto determinant = [&](const double(&m)[3][3]) {
    return m[0][0] * minor(m, 0, 0) + m[0][1] * minor(m, 0, 1) + m[0][2] * minor(m, 0, 2);
  };
  const double now = determinant(x), before = determinant(X);
  if (!(now > 0)) return INFINITY;
  // G = F^-1 = X x^-1; the largest eigenvalue of G G^T is 1 / s^2.
  double G[3][3], A[3][3], t2 = 0, t3 = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      G[i][j] = (X[i][0] * minor(x, j, 0) + X[i][1] * minor(x, j, 1) + X[i][2] * minor(x, j, 2)) / now;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A[i][j] = G[i][0] * G[j][0] + G[i][1] * G[j][1] + G[i][2] * G[j][2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double square = A[i][0] * A[0][j] + A[i][1] * A[1][j] + A[i][2] * A[2][j];
      if (i == j) t2 += square;
      t3 += square * A[j][i];
    }
  return now / before * largest_eigenvalue(A[0][0] + A[1][1] + A[2][2], t2, t3);
}

/// Where elements' corners were, are and will be.
struct DeformedShape {
  DeformedElements elements;
  Array<const double*[3]> reference, position, velocity;

  KOKKOS_INLINE_FUNCTION void modes(int e, const Array<const double* [3]>& of, double ahead, double (&x)[3][7]) const {
    for (int i = 0; i < 3; ++i) {
      double place[8];
      for (int N = 0; N < 8; ++N) {
        const int n = elements.corners(e, N);
        place[N] = of(n, i) + (ahead > 0 ? ahead * velocity(n, i) : 0.0);
      }
      modes_of(place, x[i]);
    }
  }

  /// The steps that an element allows a scene whose undeformed elements allow `limits` together, s: what it bears by
  /// itself, or by how much it has become stiffer. @param ahead s, from now, the corners moving on as now
  /// @return whether it has a volume
  template <int Limits>
  KOKKOS_INLINE_FUNCTION bool allowed(int e, double ahead, const double (&limits)[Limits],
                                      double (&steps)[Limits]) const {
    double X[3][7], x[3][7], before[3][3], now[3][3];
    modes(e, reference, 0, X);
    modes(e, position, ahead, x);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        before[i][k] = X[i][k];
        now[i][k] = x[i][k];
      }
    const double stiffer = stiffness_growth(before, now), power = elements.value(e, DeformedElements::power);
    if (!(stiffer < 1e6)) return false;
    const bool damped = std::fabs(power) > 1.5;
    const double scale = damped ? 1 / stiffer : 1 / std::sqrt(stiffer);
    double own = elements.value(e, DeformedElements::own_step);
    if (stiffer > hardly && own > 0) {
      const double ratio = elements.value(e, DeformedElements::lame_ratio);
      const double change = elements.value(e, DeformedElements::stiffness) / stiffness_over_mass(x, ratio);
      own *= change < 1e300 ? (damped ? change : std::sqrt(change)) : 0;
    }
    for (int k = 0; k < Limits; ++k) steps[k] = power < 0 ? own : std::fmax(own, scale * limits[k]);
    return true;
  }

  /// An element that is so little stiffer is as good as undeformed.
  static constexpr double hardly = 1.002;
};

/// Minus the step that the scene may take as far as an element knows, by two limits of the undeformed scene, s; squared
/// speed of a corner, m2/s2. Elements without volume have no say.
struct DeformedStepNow {
  static constexpr int values = 3;
  DeformedShape shape;
  double limits[2];

  KOKKOS_INLINE_FUNCTION void operator()(int e, double* value) const {
    double steps[2];
    const bool solid = shape.allowed(e, 0, limits, steps);
    for (int k = 0; k < 2; ++k) value[k] = solid ? -steps[k] : -1e300;
    const Vector3 v = row(shape.velocity, shape.elements.corners(e, 0));
    value[2] = dot(v, v);
  }
};

/// Minus the step that the scene may take as far as an element knows, s; minus the number of steps after which it
/// allows no more than `least`, s, moving on as now; largest relative loss of allowed step in a step, of elements that
/// are not far from that.
struct DeformedStepAhead {
  static constexpr int values = 3;
  DeformedShape shape;
  double limit[1], step, least;

  KOKKOS_INLINE_FUNCTION void operator()(int e, double* value) const {
    double now[1], next[1];
    value[0] = value[1] = -1e300;
    value[2] = 0;
    if (!shape.allowed(e, 0, limit, now)) return;
    value[0] = -now[0];
    const double loss = shape.allowed(e, step, limit, next) ? 1 - next[0] / now[0] : 1;
    if (!(loss > 0)) return;
    // ln(now / least) is at least that.
    value[1] = -std::fmax(0.0, 1 - least / now[0]) / loss;
    if (now[0] < 1.5 * least) value[2] = loss;
  }
};

}  // namespace railwave
