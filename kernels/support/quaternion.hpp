#pragma once

#include "kernels/support/vector3.hpp"

namespace railwave {

/// A rotation: cos(angle/2), sin(angle/2) times the axis.
struct Quaternion {
  double w;
  Vector3 v;
};

KOKKOS_INLINE_FUNCTION Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

KOKKOS_INLINE_FUNCTION Quaternion reversed(const Quaternion& q) { return {q.w, -1.0 * q.v}; }

KOKKOS_INLINE_FUNCTION Vector3 turned(const Quaternion& q, const Vector3& x) {
  const Vector3 twice = 2.0 * cross(q.v, x);
  return x + q.w * twice + cross(q.v, twice);
}

/// Of length one again, which rounding takes away.
KOKKOS_INLINE_FUNCTION Quaternion of_length_one(const Quaternion& q) {
  const double scale = 1 / std::sqrt(q.w * q.w + dot(q.v, q.v));
  return {scale * q.w, scale * q.v};
}

/// The rotation about a vector by its length, rad.
KOKKOS_INLINE_FUNCTION Quaternion turn_about(const Vector3& angle) {
  const double half = 0.5 * norm(angle);
  const double share = half > 1e-8 ? 0.5 * std::sin(half) / half : 0.5;
  return {std::cos(half), share * angle};
}

template <class QuaternionArray>
KOKKOS_INLINE_FUNCTION Quaternion quaternion(const QuaternionArray& values, int n) {
  return {values(n, 0), {{values(n, 1), values(n, 2), values(n, 3)}}};
}

}  // namespace railwave
