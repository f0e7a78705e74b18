#pragma once

#include <memory>
#include <vector>

#include "kernels/contact/multiplier_arrays.hpp"
#include "kernels/nodes/shared_nodes.hpp"
#include "kernels/support/team_reduction.hpp"
#include "model/boundaries/prescribed_nodes.hpp"
#include "model/elements/element_model.hpp"
#include "model/elements/relative_coordinates.hpp"
#include "model/subcycling.hpp"

namespace railwave {

/// [begin, end).
struct IndexRange {
  int begin = 0, end = 0;
};

/// The nodes of a model, what moves them, and the instant: forces and positions at `time`, velocities `velocity_lag`
/// seconds before it. Every task works on it.
struct NodalState {
  NodeArrays nodes;
  RelativeNodes relative;
  Array<double* [3][3]> constraints;
  Subcycling subcycling;
  PartialForces partial;
  SharedNodes shared;        ///< those that no block advances by itself
  int first_late = 0;        ///< of them: those from there on wait for ties, multipliers, prescribed motions or ends
  IndexRange between_ranks;  ///< of them: those with blocks of several ranks; empty in one process
  int early_shared = 0;      ///< so many, the first, move beside what the others wait for; 0 on a host
  bool plain_apart = false;  ///< whether those before shared.first_special have a launch of their own
  ElementParts parts;        ///< in which an advancing step computes the elements
  Array<int*> own_nodes;     ///< those that a rank moves; empty: all
  ExternalForces external;
  FreeNodeArrays free_nodes;  ///< of contacts by multipliers; empty without
  std::vector<PrescribedSet> prescribed;
  Vector3 gravity{{0, 0, 0}};  ///< m/s2
  std::shared_ptr<ReductionSpace> reduction_space =
      std::make_shared<ReductionSpace>();  ///< of the account, the monitor, the static start

  double time = 0;  ///< s
  long step = 0;
  double velocity_lag = 0;  ///< s

  int node_count() const { return nodes.count; }

  /// Force and acceleration of a node from what the last force phase left in the arrays.
  NodalAcceleration acceleration() const { return {{nodes, partial, external.sum}, gravity, constraints}; }

  /// The same as the scheme uses it at an instant when all levels are in phase: v(t) = v(stored) + steps lag
  /// acceleration.
  SubcycledAcceleration subcycled_acceleration() const { return {acceleration(), subcycling.node_levels}; }
};

}  // namespace railwave
