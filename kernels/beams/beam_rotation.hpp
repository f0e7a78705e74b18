#pragma once

#include "kernels/beams/beam.hpp"
#include "kernels/nodes/nodes.hpp"

namespace railwave {

/// Angular acceleration of a beam node: moments gathered in fixed order, directions about which it is held taken out.
/// Its inertia is the same about all axes, so that there is no gyroscopic term.
struct BeamNodeMoment {
  BeamArrays beams;

  KOKKOS_INLINE_FUNCTION Vector3 free(int n, const Vector3& x) const {
    return projected(beams.projections, beams.constraint(n), x);
  }

  KOKKOS_INLINE_FUNCTION Vector3 moment(int n) const {
    Vector3 sum{{0, 0, 0}};
    for (int k = beams.first_moment(n); k < beams.first_moment(n + 1); ++k)
      sum = sum + row(beams.moment, beams.moment_of_node(k));
    return free(n, sum);
  }

  KOKKOS_INLINE_FUNCTION Vector3 acceleration(int n) const { return (1 / beams.inertia(n)) * moment(n); }

  /// @param angle rad, by which the node turns on
  KOKKOS_INLINE_FUNCTION void turn(int n, const Vector3& angle) const {
    const Quaternion q = of_length_one(turn_about(angle) * quaternion(beams.rotation, n));
    beams.rotation(n, 0) = q.w;
    for (int i = 0; i < 3; ++i) beams.rotation(n, 1 + i) = q.v[i];
  }
};

/// Central difference of the rotations, as of the places: spins half a step ahead, then the exponential map (Simo and
/// Vu-Quoc 1986).
struct BeamRotationUpdate {
  BeamNodeMoment node;
  double velocity_step;  ///< s: half a step at the first one
  double step;           ///< s

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const Vector3 next = row(node.beams.spin, n) + velocity_step * node.acceleration(n);
    for (int i = 0; i < 3; ++i) node.beams.spin(n, i) = next[i];
    node.turn(n, step * next);
  }
};

/// Kinetic energy of the rotations at t_n, as NodalEnergy has that of the nodes.
struct BeamKineticEnergy {
  static constexpr int values = 1;
  BeamNodeMoment node;
  double lag, step;
  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    const Vector3 a = node.acceleration(n), stored = row(node.beams.spin, n);
    sum[0] += 0.5 * node.beams.inertia(n) * dot(stored + (lag - 0.5 * step) * a, stored + (lag + 0.5 * step) * a);
  }
};

/// A step of a unit of pseudo-time towards equilibrium, as RelaxationUpdate takes it.
struct BeamRelaxation {
  BeamNodeMoment node;
  Array<const double*> inertia;  ///< kg m2 for a unit step
  double damping;                ///< share of the unbalanced moment

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const Vector3 moment = node.moment(n);
    Vector3 damped;
    for (int i = 0; i < 3; ++i) {
      const double w = node.beams.spin(n, i);
      const double against = w > 0 ? 1.0 : w < 0 ? -1.0 : 0.0;
      damped[i] = moment[i] - damping * std::fabs(moment[i]) * against;
    }
    const Vector3 next = row(node.beams.spin, n) + (1 / inertia(n)) * node.free(n, damped);
    for (int i = 0; i < 3; ++i) node.beams.spin(n, i) = next[i];
    node.turn(n, next);
  }
};

/// Twice the relaxation's kinetic energy, and the unbalanced moments and those from outside as forces on an arm.
struct BeamRelaxationSums {
  static constexpr int values = 3;
  BeamNodeMoment node;
  Array<const double*> inertia, arm;
  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    const BeamArrays& beams = node.beams;
    sum[0] += inertia(n) * dot(row(beams.spin, n), row(beams.spin, n));
    sum[1] += norm(node.moment(n)) / arm(n);
    for (int k = beams.first_moment(n); k < beams.first_moment(n + 1); ++k)
      if (beams.moment_of_node(k) >= 2 * beams.count)
        sum[2] += norm(row(beams.moment, beams.moment_of_node(k))) / arm(n);
  }
};

}  // namespace railwave
