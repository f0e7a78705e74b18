#pragma once

#include "kernels/extra_force.hpp"
#include "kernels/set_motion.hpp"

namespace railwave {

/// Linear spring and dashpot along three axes between the mean motions of two sets; set -1 is the ground.
struct ConnectorArrays {
  int count = 0;
  Array<int* [2]> set;               ///< from, to
  Array<double* [3]> rest;           ///< m, position of `to` relative to `from` before the run
  Array<double* [3][3]> axes;        ///< rows: unit vectors
  Array<double* [3]> stiffness;      ///< N/m along the axes
  Array<double* [3]> damping;        ///< N s/m
  Array<double* [3]> preload;        ///< N on `to` at rest, global axes
  Array<double* [3]> force;          ///< N on `to`
  Array<double* [2]> energy;         ///< J: stored (spring, and potential of the preload), dissipated so far
};

struct ConnectorForce {
  ConnectorArrays connectors;
  NodeSets sets;
  double elapsed;         ///< s since the last step
  double damping_factor;  ///< 1; 0 while settling, where velocities have no physical meaning

  KOKKOS_INLINE_FUNCTION void operator()(const int c) const {
    double relative[6];
    for (int i = 0; i < 6; ++i) {
      relative[i] = i < 3 ? -connectors.rest(c, i) : 0.0;
      if (connectors.set(c, 1) >= 0) relative[i] += sets.motion(connectors.set(c, 1), i);
      if (connectors.set(c, 0) >= 0) relative[i] -= sets.motion(connectors.set(c, 0), i);
    }
    Vector3 force = row(connectors.preload, c);
    double stored = 0, power = 0;
    for (int i = 0; i < 3; ++i) stored -= force[i] * relative[i];
    for (int a = 0; a < 3; ++a) {
      double stretch = 0, rate = 0;
      for (int i = 0; i < 3; ++i) {
        stretch += connectors.axes(c, a, i) * relative[i];
        rate += connectors.axes(c, a, i) * relative[3 + i];
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

/// Shares a connector's force over the nodes of its two ends by weight.
struct ConnectorContribution {
  ExtraForces extra;
  ConnectorArrays connectors;
  int first;                       ///< contributions first, first + 1, ...
  Array<const int*> connector;     ///< of each contribution
  Array<const double*> share;      ///< weight, negative at `from`

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int k = 0; k < 3; ++k) extra.contribution(first + i, k) = share(i) * connectors.force(connector(i), k);
  }
};

}  // namespace railwave
