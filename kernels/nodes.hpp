#pragma once

#include "kernels/spaces.hpp"

namespace railwave {

/// State and constant data of all nodes. Forces at an instant t_n, velocities half a step before it.
struct NodeArrays {
  int count = 0;
  Array<double* [3]> reference;    ///< m, undeformed
  Array<double* [3]> position;     ///< m, at t_n
  Array<double* [3]> velocity;     ///< m/s, at t_n - step/2
  Array<double*> mass;             ///< kg, lumped
  Array<int*> first_corner;        ///< count + 1; a node's corners are corner[first_corner(n)] ... in fixed order
  Array<long*> corner;             ///< place of the corner's x force in the corner force array; y and z follow by tile_width
  Array<int*> extra;               ///< row in the extra forces (loads, connectors, contact), -1: none
  Array<int*> constraint;          ///< row in the constraint table, -1: free
};

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

/// Sum of the element forces on a node and of its extra forces, in fixed order, N.
struct NodalForce {
  NodeArrays nodes;
  Array<const double*> corner_force;
  Array<const double* [3]> extra_force;
  int stride;  ///< between the components of a corner force: tile_width

  KOKKOS_INLINE_FUNCTION Vector3 operator()(int n) const {
    Vector3 force{{0, 0, 0}};
    const int row_of_extra = nodes.extra(n);
    if (row_of_extra >= 0) force = row(extra_force, row_of_extra);
    for (int c = nodes.first_corner(n); c < nodes.first_corner(n + 1); ++c) {
      const double* f = corner_force.data() + nodes.corner(c);
      force[0] += f[0];
      force[1] += f[stride];
      force[2] += f[2 * stride];
    }
    return force;
  }
};

/// Acceleration with displacement constraints: components along constrained directions are zero (thesis 2.7, eqs. 2.31).
/// Each row of the table is the projection I - sum d d^T over a node's constrained directions d, so a constrained
/// direction keeps the velocity it began with.
struct NodalAcceleration {
  NodalForce force;
  Vector3 gravity;                          ///< m/s2
  Array<const double* [3][3]> constraints;  ///< projections

  KOKKOS_INLINE_FUNCTION Vector3 constrain(int n, const Vector3& a) const {
    const int c = force.nodes.constraint(n);
    if (c < 0) return a;
    Vector3 free;
    for (int i = 0; i < 3; ++i)
      free[i] = constraints(c, i, 0) * a[0] + constraints(c, i, 1) * a[1] + constraints(c, i, 2) * a[2];
    return free;
  }

  KOKKOS_INLINE_FUNCTION Vector3 operator()(int n) const {
    return constrain(n, (1.0 / force.nodes.mass(n)) * force(n) + gravity);
  }
};

/// Step 3 of the thesis's table 2.1, (f) to (j): acceleration, constraints, central difference (eqs. 2.11, 2.12).
struct NodeUpdate {
  NodalAcceleration acceleration;
  double velocity_step;  ///< s: half a step at the first one, which starts from velocities at t = 0
  double step;           ///< s

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const NodeArrays& nodes = acceleration.force.nodes;
    const Vector3 a = acceleration(n);
    for (int i = 0; i < 3; ++i) {
      const double v = nodes.velocity(n, i) + velocity_step * a[i];
      nodes.velocity(n, i) = v;
      nodes.position(n, i) += step * v;
    }
  }
};

}  // namespace railwave
