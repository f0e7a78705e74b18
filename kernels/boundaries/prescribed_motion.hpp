#pragma once

#include "kernels/nodes/nodes.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave {

/// Where a rigid motion has brought a body: X goes to place + turn (X - centre).
struct RigidPlace {
  Vector3 centre, place;  ///< m, of the centre in the undeformed body and now
  double turn[3][3];

  KOKKOS_INLINE_FUNCTION Vector3 operator()(const Vector3& reference) const {
    const Vector3 arm = reference - centre;
    Vector3 x = place;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) x[i] += turn[i][j] * arm[j];
    return x;
  }
};

/// Gives the nodes of a set, held in the prescribed directions, the velocity along these that brings them where the
/// rigid motion will be at the next instant, so that no error adds up; and counts the work that this takes: of a node
/// with mass m and, all along these directions, velocity v and force F at t_n
///   m (v(n+1/2)^2 - v(n-1/2)^2) / 2 - F . ((t_n - t_(n-1)) v(n-1/2) + (t_(n+1) - t_n) v(n+1/2)) / 2.
/// Over the steps that is the change of kinetic energy and the trapezoidal rule of the forces' work.
struct PrescribedMotion {
  NodalForce force;
  Vector3 gravity;  ///< m/s2
  Array<const int*> nodes;
  Array<double*> work;  ///< J, by node of the set
  StepValue<RigidPlace> next;
  double lag;         ///< s, half of the step before; 0 at the first
  double step;        ///< s
  double held[3][3];  ///< sum of d d^T over the prescribed directions d

  KOKKOS_INLINE_FUNCTION Vector3 prescribed(const Vector3& v) const {
    Vector3 along{{0, 0, 0}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) along[i] += held[i][j] * v[j];
    return along;
  }

  /// m/s, what the step to come has along the prescribed directions
  KOKKOS_INLINE_FUNCTION Vector3 next_velocity(const int n) const {
    const NodeArrays& all = force.nodes;
    return prescribed((1.0 / step) * (next()(row(all.reference, n)) - row(all.position, n)));
  }

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const int n = nodes(k);
    const NodeArrays& all = force.nodes;
    const double mass = all.mass(n);
    const Vector3 before = prescribed(row(all.velocity, n));
    const Vector3 now = next_velocity(n);
    const Vector3 acting = force(n) + mass * gravity;
    work(k) += 0.5 * mass * (dot(now, now) - dot(before, before)) - dot(acting, lag * before + (0.5 * step) * now);
    for (int i = 0; i < 3; ++i) all.velocity(n, i) += now[i] - before[i];
  }
};

/// The work done so far: what was counted until the step before, and the part of the present forces that belongs to it.
struct PrescribedWork {
  static constexpr int values = 1;
  PrescribedMotion motion;

  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const int n = motion.nodes(k);
    const Vector3 acting = motion.force(n) + motion.force.nodes.mass(n) * motion.gravity;
    sum[0] += motion.work(k) - motion.lag * dot(acting, motion.prescribed(row(motion.force.nodes.velocity, n)));
  }
};

/// The force that moves the set, N: of a node m a - F along the prescribed directions, with a as follows.
struct PrescribedReaction {
  static constexpr int values = 3;
  PrescribedMotion motion;  ///< of the step to come

  /// m/s2, along the prescribed directions: (v(n+1/2) - v(n-1/2)) / (t_(n+1/2) - t_(n-1/2))
  KOKKOS_INLINE_FUNCTION Vector3 acceleration(int n) const {
    const Vector3 change = motion.next_velocity(n) - motion.prescribed(row(motion.force.nodes.velocity, n));
    return (1.0 / (motion.lag + 0.5 * motion.step)) * change;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const int n = motion.nodes(k);
    const double mass = motion.force.nodes.mass(n);
    const Vector3 force = mass * acceleration(n) - motion.prescribed(motion.force(n) + mass * motion.gravity);
    for (int i = 0; i < 3; ++i) sum[i] += force[i];
  }
};

/// How nodes accelerate along the prescribed directions, in which the scheme's own accelerations are 0.
struct PrescribedAcceleration {
  PrescribedReaction reaction;
  int first;                        ///< of the set in `acceleration`
  Array<double* [3]> acceleration;  ///< m/s2, of all sets

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const Vector3 own = reaction.acceleration(reaction.motion.nodes(k));
    for (int i = 0; i < 3; ++i) acceleration(first + k, i) = own[i];
  }
};

}  // namespace railwave
