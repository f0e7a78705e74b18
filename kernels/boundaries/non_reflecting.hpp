#pragma once

#include "kernels/nodes/subcycled_nodes.hpp"

/// Non-reflecting ends: the traction -rho C_d v_n n - rho C_s v_t of Lysmer and Kuhlemeyer 1969 on a surface's faces,
/// lumped at their nodes.
namespace railwave {

struct NonReflectingArrays {
  int count = 0;
  Array<int*> nodes;
  Array<double* [6]> dashpot;  ///< N s/m: C as xx, yy, zz, yz, zx, xy, without constrained directions
  Array<double* [3]> support;  ///< N, what held the node when the scene had settled, constant in the run
  Array<double* [3]> start;    ///< m, where the node was when the run began
  Array<double* [3]> force;    ///< N, of the dashpots at the node's last instant
  Array<double*> dissipated;   ///< J
};

/// C v of a symmetric matrix kept as xx, yy, zz, yz, zx, xy.
KOKKOS_INLINE_FUNCTION Vector3 symmetric_product(const double (&c)[6], const Vector3& v) {
  return {{c[0] * v[0] + c[5] * v[1] + c[4] * v[2], c[5] * v[0] + c[1] * v[1] + c[3] * v[2],
           c[4] * v[0] + c[3] * v[1] + c[2] * v[2]}};
}

/// x of A x = b, by cofactors; A symmetric and definite, in the same order.
KOKKOS_INLINE_FUNCTION Vector3 symmetric_solve(const double (&a)[6], const Vector3& b) {
  const double inverse[6] = {a[1] * a[2] - a[3] * a[3], a[0] * a[2] - a[4] * a[4], a[0] * a[1] - a[5] * a[5],
                             a[4] * a[5] - a[0] * a[3], a[3] * a[5] - a[1] * a[4], a[3] * a[4] - a[2] * a[5]};
  return (1 / (a[0] * inverse[0] + a[5] * inverse[5] + a[4] * inverse[4])) * symmetric_product(inverse, b);
}

/// Forces of an instant on the ends' nodes, after all other forces. The dashpots feel the velocity of the instant
/// itself, v_n = v_(n-1/2) + h a with h half the step, so (m + h C) a = F - C v_(n-1/2): dashpots so taken do not bear
/// on the stable step, and what they dissipate, v_n . C v_n, is never negative.
struct NonReflectingForce {
  NonReflectingArrays ends;
  SubcycledAcceleration acceleration;
  double lag;      ///< s from the velocities' instant to this one, half a step; 0 at a run's first
  double elapsed;  ///< s since the instant before; 0 at the first

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const int n = ends.nodes(i), r = nodes.external_row(n), steps = acceleration.levels.steps(n);
    if (acceleration.levels.level.extent(0) != 0 && acceleration.levels.level(n) > acceleration.phase) return;
    const double mass = nodes.mass(n), half = steps * lag;
    const Vector3 v = row(nodes.velocity, n), support = row(ends.support, i);
    double dashpot[6], matrix[6];
    for (int k = 0; k < 6; ++k) {
      dashpot[k] = ends.dashpot(i, k);
      matrix[k] = half * dashpot[k] + (k < 3 ? mass : 0.0);
    }
    const Vector3 others = mass * acceleration(n) + support;
    const Vector3 a = symmetric_solve(matrix, others - symmetric_product(dashpot, v));
    const Vector3 now = -1.0 * symmetric_product(dashpot, v + half * a);
    // The trapezoidal rule, as of all loads: the account's kinetic energy changes by just that.
    ends.dissipated(i) -= 0.5 * steps * elapsed * dot(row(ends.force, i) + now, v);
    for (int k = 0; k < 3; ++k) {
      ends.force(i, k) = now[k];
      acceleration.plain.force.external.load(r, k) += now[k] + support[k];
    }
  }
};

/// Where the run begins: what held the nodes while the scene settled, or nothing.
struct HoldEnds {
  NonReflectingArrays ends;
  Array<const double* [3]> position;
  Array<const double* [3]> unbalanced;  ///< N by node, of everything else; empty: the scene has not settled

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int k = 0; k < 3; ++k) {
      ends.support(i, k) = unbalanced.extent(0) == 0 ? 0.0 : -unbalanced(ends.nodes(i), k);
      ends.start(i, k) = position(ends.nodes(i), k);
      ends.force(i, k) = 0;
    }
    ends.dissipated(i) = 0;
  }
};

/// Dissipated by the dashpots, and work of the supports.
struct NonReflectingEnergy {
  static constexpr int values = 2;
  NonReflectingArrays ends;
  Array<const double* [3]> position;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const {
    sum[0] += ends.dissipated(i);
    sum[1] += dot(row(ends.support, i), row(position, ends.nodes(i)) - row(ends.start, i));
  }
};

}  // namespace railwave
