#pragma once

#include <memory>
#include <vector>

#include "kernels/nodes/carried_nodes.hpp"
#include "kernels/nodes/nodes.hpp"
#include "kernels/support/reduction_space.hpp"
#include "model/subcycling.hpp"

namespace railwave {

/// Nodes in single precision and their carriers, one for each part and point mass: the rigid motion that suits its
/// velocities best when the run begins. From then on these nodes are the state, and the double ones follow: those that
/// extra forces or constraints concern at every step, the others when somebody looks. Empty unless the case asks for
/// precision = "float".
struct CarriedNodes {
  struct Range {
    int first, count;  ///< nodes of a carrier
  };

  Array<CarriedNode*> node;
  Array<CarriedArm*> shared_arm;  ///< of each shared node
  Array<CarrierMotion*> motion;   ///< by carrier
  Array<CarrierStep*> steps;      ///< of a block of steps, see LayCarrierSteps
  std::vector<Range> range;       ///< by carrier
  std::vector<CarrierMotion> host_motion;
  bool begun = false;     ///< the nodes have been taken over
  long block_step = 0;    ///< the block's first step
  double block_time = 0;  ///< s, its time since the nodes were taken over
  double block_size = 0;  ///< s, of its steps; 0: none is laid

  bool active() const { return !range.empty(); }
  double time_of(long step) const { return block_time + static_cast<double>(step - block_step) * block_size; }
};

/// The nodes of a model, what moves them, and the instant: forces and positions at `time`, velocities `velocity_lag`
/// seconds before it. Every task works on it.
struct NodalState {
  NodeArrays nodes;
  CarriedNodes carried;
  Array<double* [3][3]> constraints;
  Subcycling subcycling;
  PartialForces partial;
  Array<SharedNode*> shared_nodes;  ///< those that no block advances by itself
  ExtraForces extra;
  Vector3 gravity{{0, 0, 0}};  ///< m/s2
  std::shared_ptr<ReductionSpace> reduction_space =
      std::make_shared<ReductionSpace>();  ///< of the account, the watch, the static start

  double time = 0;  ///< s
  long step = 0;
  double velocity_lag = 0;  ///< s

  int node_count() const { return nodes.count; }

  /// Force and acceleration of a node from what the last force phase left in the arrays.
  NodalAcceleration acceleration() const { return {{nodes, partial, extra.sum}, gravity, constraints}; }

  /// The same as the scheme uses it at an instant when all levels are in phase: v(t) = v(stored) + pace lag
  /// acceleration.
  PacedAcceleration paced_acceleration() const { return {acceleration(), subcycling.paces}; }
};

}  // namespace railwave
