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

/// How a rigid motion moves at an instant.
struct RigidRates {
  RigidPlace at;
  Vector3 velocity, acceleration;  ///< m/s, m/s2, of the centre
  Vector3 spin, spin_rate;         ///< rad/s, rad/s2

  KOKKOS_INLINE_FUNCTION Vector3 arm(const Vector3& reference) const { return at(reference) - at.place; }

  KOKKOS_INLINE_FUNCTION Vector3 velocity_of(const Vector3& reference) const {
    return velocity + cross(spin, arm(reference));
  }

  KOKKOS_INLINE_FUNCTION Vector3 acceleration_of(const Vector3& reference) const {
    const Vector3 r = arm(reference);
    return acceleration + cross(spin_rate, r) + cross(spin, cross(spin, r));
  }
};

/// Along the prescribed directions d, by the sum of d d^T.
KOKKOS_INLINE_FUNCTION Vector3 along_held(const double (&held)[3][3], const Vector3& v) {
  Vector3 along{{0, 0, 0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) along[i] += held[i][j] * v[j];
  return along;
}

/// How the nodes of a set move at t_n itself along the prescribed directions, in which the scheme has them no
/// acceleration and the velocity of half a step before.
struct PrescribedInstant {
  NodeArrays nodes;
  RigidRates rates;
  double held[3][3];
  bool begun;  ///< false at a run's first instant: the nodes have the velocities that they begin with

  /// m/s, of a node that has the velocity v, held directions half a step before or at t_n
  KOKKOS_INLINE_FUNCTION Vector3 velocity_change(int n, const Vector3& v) const {
    if (!begun) return {{0, 0, 0}};
    return along_held(held, rates.velocity_of(row(nodes.reference, n)) - v);
  }

  KOKKOS_INLINE_FUNCTION Vector3 acceleration(int n) const {
    return along_held(held, rates.acceleration_of(row(nodes.reference, n)));
  }

  /// J, by how much kinetic energy at t_n is above that of half a step before
  KOKKOS_INLINE_FUNCTION double energy_change(int n) const {
    const Vector3 before = along_held(held, row(nodes.velocity, n)), now = before + velocity_change(n, before);
    return 0.5 * nodes.mass(n) * (dot(now, now) - dot(before, before));
  }
};

/// Along perpendicular directions several of these may move the same nodes: none of them changes what another reads.
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

  KOKKOS_INLINE_FUNCTION Vector3 prescribed(const Vector3& v) const { return along_held(held, v); }

  KOKKOS_INLINE_FUNCTION Vector3 acting(const int n) const { return force(n) + force.nodes.mass(n) * gravity; }

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const int n = nodes(k);
    const NodeArrays& all = force.nodes;
    const double mass = all.mass(n);
    const Vector3 before = prescribed(row(all.velocity, n));
    const Vector3 now = prescribed((1.0 / step) * (next()(row(all.reference, n)) - row(all.position, n)));
    work(k) += 0.5 * mass * (dot(now, now) - dot(before, before)) - dot(acting(n), lag * before + (0.5 * step) * now);
    for (int i = 0; i < 3; ++i) all.velocity(n, i) += now[i] - before[i];
  }
};

/// The work done so far: what was counted until the step before, and what of the present forces and of the velocity at
/// t_n belongs to it; and that velocity's part of the kinetic energy, which the nodes' own account has of half a step
/// before.
struct PrescribedWork {
  static constexpr int values = 2;
  PrescribedMotion motion;
  PrescribedInstant instant;

  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const int n = motion.nodes(k);
    const Vector3 before = motion.prescribed(row(motion.force.nodes.velocity, n));
    const double kinetic = instant.energy_change(n);
    sum[0] += motion.work(k) - motion.lag * dot(motion.acting(n), before) + kinetic;
    sum[1] += kinetic;
  }
};

/// The force that moves the set, N: of a node m a - F along the prescribed directions.
struct PrescribedReaction {
  static constexpr int values = 3;
  PrescribedMotion motion;
  PrescribedInstant instant;

  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const int n = motion.nodes(k);
    const Vector3 force = motion.force.nodes.mass(n) * instant.acceleration(n) - motion.prescribed(motion.acting(n));
    for (int i = 0; i < 3; ++i) sum[i] += force[i];
  }
};

/// What the scheme's velocities, half a step before, and accelerations of driven nodes lack at t_n. A node that several
/// motions drive, along perpendicular directions, has their sum.
struct PrescribedChange {
  PrescribedInstant instant;
  Array<const int*> nodes;
  Array<const int*> rows;     ///< in `change`, of the nodes of all sets, set after set; ~row: an earlier set has it too
  int first;                  ///< of this set in `rows`
  Array<double* [6]> change;  ///< m/s and m/s2

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const int n = nodes(k);
    const Vector3 faster = instant.velocity_change(n, row(instant.nodes.velocity, n)), own = instant.acceleration(n);
    const bool again = rows(first + k) < 0;
    const int r = again ? ~rows(first + k) : rows(first + k);
    for (int i = 0; i < 3; ++i) {
      change(r, i) = again ? change(r, i) + faster[i] : faster[i];
      change(r, 3 + i) = again ? change(r, 3 + i) + own[i] : own[i];
    }
  }
};

/// An entry of a field of some nodes, and its node.
struct FieldEntry {
  int entry, node;
};

/// The same in such a field, three values each.
struct PrescribedField {
  PrescribedInstant instant;
  Array<const FieldEntry*> wanted;
  bool velocities;  ///< else accelerations
  Array<double*> field;

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const std::size_t first = 3 * static_cast<std::size_t>(wanted(k).entry);
    const int n = wanted(k).node;
    const Vector3 v{{field(first), field(first + 1), field(first + 2)}};
    const Vector3 change = velocities ? instant.velocity_change(n, v) : instant.acceleration(n);
    for (int i = 0; i < 3; ++i) field(first + i) += change[i];
  }
};

}  // namespace railwave
