#pragma once

#include "kernels/support/vector3.hpp"

/// Co-rotating reference frames: rigid motions that go on for ever, each at a constant velocity and a constant angular
/// velocity. The coordinates of nodes in single precision are relative to one: x_n = c_n + R_n (X - c_0) + d_n,
/// v = the frame's + w. What remains, d and w, is small, so that single precision suffices for it, and the scheme for x
/// is the central difference as ever:
///   w_(n+1/2) = w_(n-1/2) + (velocity step) a - M_n R_n (X - c_0),   d_(n+1) = d_n + step w_(n+1/2),
/// where M_n R_n (X - c_0) is by how much the frame's own velocity changes from half a step before to half a step
/// after.
namespace railwave {

/// Rows of a 3 by 3 matrix.
template <class S>
struct Matrix3 {
  S a[9];

  KOKKOS_FORCEINLINE_FUNCTION S operator()(int i, int j) const { return a[3 * i + j]; }
};

KOKKOS_INLINE_FUNCTION Vector3 operator*(const Matrix3<double>& m, const Vector3& x) {
  Vector3 y;
  for (int i = 0; i < 3; ++i) y[i] = m(i, 0) * x[0] + m(i, 1) * x[1] + m(i, 2) * x[2];
  return y;
}

KOKKOS_INLINE_FUNCTION Matrix3<double> operator*(const Matrix3<double>& m, const Matrix3<double>& n) {
  Matrix3<double> y;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) y.a[3 * i + j] = m(i, 0) * n(0, j) + m(i, 1) * n(1, j) + m(i, 2) * n(2, j);
  return y;
}

struct FrameMotion {
  Vector3 axis{{0, 0, 1}};      ///< of unit length
  double speed = 0;             ///< rad/s
  Vector3 centre{{0, 0, 0}};    ///< m, c_0
  Vector3 velocity{{0, 0, 0}};  ///< m/s, of the centre

  /// s K + c K^2, where K x = axis x x. The turn by an angle is I + this with s its sine and c twice the squared sine
  /// of its half, which loses no digits at the tiny angle of a step.
  KOKKOS_INLINE_FUNCTION Matrix3<double> form(double s, double c) const {
    const double x = axis[0], y = axis[1], z = axis[2];
    return {{c * (x * x - 1), c * x * y - s * z, c * x * z + s * y, c * x * y + s * z, c * (y * y - 1),
             c * y * z - s * x, c * x * z - s * y, c * y * z + s * x, c * (z * z - 1)}};
  }

  KOKKOS_INLINE_FUNCTION Matrix3<double> turn(double time) const {
    const double half = std::sin(0.5 * speed * time);
    Matrix3<double> result = form(std::sin(speed * time), 2 * half * half);
    for (int i = 0; i < 3; ++i) result.a[4 * i] += 1;
    return result;
  }

  KOKKOS_INLINE_FUNCTION Vector3 centre_at(double time) const { return centre + time * velocity; }

  /// Mean velocity over a step ahead for each arm, (dR(h) - I)/h, 1/s.
  KOKKOS_INLINE_FUNCTION Matrix3<double> rate_after(double step) const {
    const double half = std::sin(0.5 * speed * step);
    return form(std::sin(speed * step) / step, 2 * half * half / step);
  }

  /// The same over a step behind, (I - dR(-h))/h; at h = 0 the velocity itself.
  KOKKOS_INLINE_FUNCTION Matrix3<double> rate_before(double step) const {
    if (step == 0) return form(speed, 0);
    const double half = std::sin(0.5 * speed * step);
    return form(std::sin(speed * step) / step, -2 * half * half / step);
  }
};

/// A frame at an instant, with its velocity half a step before.
struct FrameInstant {
  Matrix3<double> turn, rate;  ///< R_n; of arms X - c_0 as they were at the start, 1/s
  Vector3 now, before;         ///< m: c_n, c_0
  Vector3 velocity;            ///< m/s

  KOKKOS_INLINE_FUNCTION Vector3 position(const Vector3& X) const { return now + turn * (X - before); }
  KOKKOS_INLINE_FUNCTION Vector3 velocity_of(const Vector3& X) const { return velocity + rate * (X - before); }
};

KOKKOS_INLINE_FUNCTION FrameInstant frame_at(const FrameMotion& motion, double time, double step_before) {
  const Matrix3<double> turn = motion.turn(time);
  return {turn, motion.rate_before(step_before) * turn, motion.centre_at(time), motion.centre, motion.velocity};
}

/// What a step needs of a frame.
struct alignas(16) FrameStep {
  Matrix3<float> turn;             ///< R_n
  Matrix3<float> rate;             ///< over the step before, of turned arms, 1/s
  Matrix3<float> change;           ///< M_n, of turned arms, 1/s
  Matrix3<float> change_at_start;  ///< the same, M_n R_n, of arms as they were at the start
  FrameInstant next;               ///< at t_(n+1), with the velocity of t_(n+1/2)
};

/// Works out the steps of a block: value k frames + c is that of frame c at the block's step k.
struct ComputeFrameSteps {
  Array<const FrameMotion*> motion;
  Array<FrameStep*> steps;
  int frames;
  double time;         ///< s, of the block's first instant
  double step_before;  ///< s, of the step that led to it; 0 at the start
  double step;         ///< s, of the block's steps

  KOKKOS_INLINE_FUNCTION static Matrix3<float> rounded(const Matrix3<double>& m) {
    Matrix3<float> result;
    for (int k = 0; k < 9; ++k) result.a[k] = static_cast<float>(m.a[k]);
    return result;
  }

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int k = i / frames;
    const FrameMotion own = motion(i % frames);
    const Matrix3<double> before = own.rate_before(k == 0 ? step_before : step), after = own.rate_after(step);
    Matrix3<double> change;
    for (int j = 0; j < 9; ++j) change.a[j] = after.a[j] - before.a[j];
    const double now = time + k * step, then = time + (k + 1) * step;
    const Matrix3<double> turn = own.turn(now);
    steps(i) = {rounded(turn),
                rounded(before),
                rounded(change),
                rounded(change * turn),
                {own.turn(then), after * turn, own.centre_at(then), own.centre, own.velocity}};
  }
};

}  // namespace railwave
