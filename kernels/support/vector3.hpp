#pragma once

#include "kernels/support/spaces.hpp"

namespace railwave {

/// A vector of three at a node.
struct Vector3 {
  double x[3];
  KOKKOS_INLINE_FUNCTION double& operator[](int i) { return x[i]; }
  KOKKOS_INLINE_FUNCTION double operator[](int i) const { return x[i]; }
};

template <class NodeArray>
KOKKOS_INLINE_FUNCTION Vector3 row(const NodeArray& values, int n) {
  return {{values(n, 0), values(n, 1), values(n, 2)}};
}
KOKKOS_INLINE_FUNCTION Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
KOKKOS_INLINE_FUNCTION Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
KOKKOS_INLINE_FUNCTION Vector3 operator*(double s, const Vector3& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
KOKKOS_INLINE_FUNCTION double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
KOKKOS_INLINE_FUNCTION Vector3 cross(const Vector3& a, const Vector3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
KOKKOS_INLINE_FUNCTION double norm(const Vector3& a) { return std::sqrt(dot(a, a)); }

}  // namespace railwave
