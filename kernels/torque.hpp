#pragma once

#include "kernels/extra_force.hpp"
#include "kernels/set_motion.hpp"

namespace railwave {

/// Torque about an axis through a set's moving centre of mass (driving torque, thesis 3.3.3), as tangential nodal forces
/// f^N = M w^N (a x r^N) / sum_K w^K |a x r^K|^2: their moment about the axis is M, their resultant zero.
struct Torque {
  ExtraForces extra;
  NodeSets sets;
  Array<const double* [3]> position, velocity;
  int set;
  int first;        ///< contributions, in the set's node order
  Vector3 axis;     ///< unit
  double moment, elapsed;

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    const Vector3 centre = {{sets.motion(set, 0), sets.motion(set, 1), sets.motion(set, 2)}};
    const int begin = sets.first(set);
    const auto range = Kokkos::TeamThreadRange(team, begin, sets.first(set + 1));
    double inertia = 0;
    Kokkos::parallel_reduce(
        range,
        [&](int k, double& sum) {
          const Vector3 arm = cross(axis, row(position, sets.nodes(k)) - centre);
          sum += sets.weight(k) * dot(arm, arm);
        },
        inertia);
    Kokkos::parallel_for(range, [&](int k) {
      const Vector3 arm = cross(axis, row(position, sets.nodes(k)) - centre);
      set_contribution(extra, velocity, first + (k - begin), (moment * sets.weight(k) / inertia) * arm, elapsed);
    });
  }
};

}  // namespace railwave
