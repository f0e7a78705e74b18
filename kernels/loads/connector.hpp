#pragma once

#include "kernels/loads/set_motion.hpp"

namespace railwave {

/// Linear spring and dashpot along three axes between the mean motions of two sets; set -1 is the ground.
struct ConnectorArrays {
  int count = 0;
  Array<int* [2]> set;           ///< from, to
  Array<double* [3]> rest;       ///< m, position of `to` relative to `from` before the run
  Array<double* [3][3]> axes;    ///< rows: unit vectors
  Array<double* [3]> stiffness;  ///< N/m along the axes
  Array<double* [3]> damping;    ///< N s/m
  Array<double* [3]> preload;    ///< N on `to` at rest, global axes
  Array<double* [3]> force;      ///< N on `to`
  Array<double* [2]> energy;     ///< J: stored (spring, and potential of the preload), dissipated so far
};

struct ConnectorForce {
  ConnectorArrays connectors;
  double elapsed;         ///< s since the last step
  double damping_factor;  ///< 1; 0 while settling, where velocities have no physical meaning

  KOKKOS_INLINE_FUNCTION void operator()(const SetMotion& sets, const int c, const SetMotion::Placed& from,
                                         const SetMotion::Placed& to) const {
    Vector3 relative = -1.0 * row(connectors.rest, c), velocity{{0, 0, 0}};
    if (to.set >= 0) {
      relative = relative + sets.mean_position(to);
      velocity = velocity + sets.mean_velocity(to.set);
    }
    if (from.set >= 0) {
      relative = relative - sets.mean_position(from);
      velocity = velocity - sets.mean_velocity(from.set);
    }
    Vector3 force = row(connectors.preload, c);
    double stored = 0, power = 0;
    for (int i = 0; i < 3; ++i) stored -= force[i] * relative[i];
    for (int a = 0; a < 3; ++a) {
      double stretch = 0, rate = 0;
      for (int i = 0; i < 3; ++i) {
        stretch += connectors.axes(c, a, i) * relative[i];
        rate += connectors.axes(c, a, i) * velocity[i];
      }
      const double k = connectors.stiffness(c, a), d = damping_factor * connectors.damping(c, a);
      stored += 0.5 * k * stretch * stretch;
      power += d * rate * rate;
      for (int i = 0; i < 3; ++i) force[i] -= (k * stretch + d * rate) * connectors.axes(c, a, i);
    }
    connectors.energy(c, 0) = stored;
    connectors.energy(c, 1) += elapsed * power;
    for (int i = 0; i < 3; ++i) connectors.force(c, i) = force[i];
  }
};

}  // namespace railwave
