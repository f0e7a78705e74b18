#pragma once

#include "kernels/loads/set_motion.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave {

/// Torques about axes through sets' moving centres of mass (driving torque, thesis 3.3.3), as tangential nodal forces
/// f^N = M w^N (a x r^N) / sum_K w^K |a x r^K|^2: their moment about the axis is M, their resultant zero.
struct TorqueArrays {
  static constexpr int most = 16;  ///< torques of a scene
  int count = 0;
  Array<int*> set;
  Array<double* [3]> axis;  ///< unit
  Array<double* [4]> now;   ///< centre (m), M / sum_K w^K |a x r^K|^2 (N/m)
};

/// From the sums over its set: what every node's force of a torque has in common.
struct TorqueNow {
  TorqueArrays torques;
  StepValue<double> moment[TorqueArrays::most] = {};  ///< N m

  KOKKOS_INLINE_FUNCTION void operator()(const SetMotion& sets, int t, const SetMotion::Placed& set) const {
    const Vector3 centre = sets.mean_position(set);
    for (int i = 0; i < 3; ++i) torques.now(t, i) = centre[i];
    torques.now(t, 3) = moment[t]() / sets.squared_arm(set.set, row(torques.axis, t));
  }
};

}  // namespace railwave
