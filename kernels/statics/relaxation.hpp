#pragma once

#include "kernels/nodes/nodes.hpp"

namespace railwave {

/// One step towards static equilibrium by dynamic relaxation with local damping (Cundall 1987): masses scaled so that
/// every element has the same stable step (one unit of pseudo-time), and a damping force on each degree of freedom that
/// is a fraction of its unbalanced force, against its velocity; it vanishes with the unbalance, so the rest state is
/// exact.
struct RelaxationUpdate {
  NodalAcceleration acceleration;        ///< its gravity is used with the true masses
  Array<const double*> relaxation_mass;  ///< kg for a unit step
  Array<const double* [3]>
      body_acceleration;          ///< m/s2, of true masses: centrifugal field of the motion to come; may be empty
  Array<double* [3]> unbalanced;  ///< N, for the check of convergence
  double damping;                 ///< share of the unbalanced force, below 1

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const NodeArrays& nodes = acceleration.force.nodes;
#ifdef RAILWAVE_SIMD_LANES
    if (n + prefetch_ahead < nodes.count) acceleration.force.prefetch_partials(n + prefetch_ahead);
#endif
    Vector3 force = acceleration.force(n) + nodes.mass(n) * acceleration.gravity;
    if (body_acceleration.extent(0) != 0) force = force + nodes.mass(n) * row(body_acceleration, n);
    force = acceleration.constrain(n, force);
    Vector3 damped;
    for (int i = 0; i < 3; ++i) {
      unbalanced(n, i) = force[i];
      const double v = nodes.velocity(n, i);
      const double against = v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0;
      damped[i] = force[i] - damping * std::fabs(force[i]) * against;
    }
    // Damping acts along the global axes and could push along a constrained oblique direction.
    damped = acceleration.constrain(n, damped);
    for (int i = 0; i < 3; ++i) {
      const double next = nodes.velocity(n, i) + damped[i] / relaxation_mass(n);
      nodes.velocity(n, i) = next;
      nodes.position(n, i) += next;
    }
  }
};

}  // namespace railwave
