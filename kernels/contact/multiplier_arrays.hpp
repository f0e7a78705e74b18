#pragma once

#include <cstdint>

#include "kernels/support/spaces.hpp"
#include "kernels/support/vector3.hpp"

namespace railwave {

inline constexpr int nodes_of_multiplier = 5;               ///< the slave's and the four of the segment
inline constexpr int most_nodes_of_multiplier = 1 + 4 * 3;  ///< where all corners are at mouths, see MouthCorner

/// What a slave node's multiplier needs in a step.
struct alignas(16) MultiplierRow {
  Vector3 normal;
  Vector3 free;  ///< m, movement of the slave over the master's material in the step without this contact's forces
  Vector3 predicted[most_nodes_of_multiplier];  ///< m, movements of the single nodes
  Vector3 force;                                ///< N on the slave, so far
  Vector3 pending;                              ///< N, what has still to be handed to the nodes
  Vector3 moved;                                ///< m, over the master's material since the step before
  double pressing;                              ///< N, normal part of `force`
  double friction;                              ///< coefficient
  double gap;                                   ///< m
  double closing;     ///< m, by how much the gap is to close in the step, at most where nothing presses yet
  double compliance;  ///< m/N, no less than what all multipliers together can move this node against the master; 0: not
                      ///< known yet
  int count;          ///< of nodes
  int node[most_nodes_of_multiplier];            ///< of the model: the slave's and the segment's
  int master[most_nodes_of_multiplier];          ///< the latter as master nodes; of the first none
  int row[most_nodes_of_multiplier];             ///< theirs in the external forces
  double weight[most_nodes_of_multiplier];       ///< 1, and minus the shape functions
  double compliances[most_nodes_of_multiplier];  ///< m/N, of FreeMotion
  int slips;
  int active;
};

/// What a contact pair has besides where its forces are multipliers; empty otherwise.
struct MultiplierArrays {
  Array<MultiplierRow*> rows;  ///< by slave
  Array<std::uint64_t*>
      multiplicity;  ///< by master: shape functions of the active slaves, in quanta; zero between steps
  Array<double* [3]> way_since_stuck;    ///< m, by slave
  int most_nodes = nodes_of_multiplier;  ///< of a row
  Array<double*> impact_energy;          ///< J, by slave: what normal forces have taken out of the bodies so far
  bool active() const { return rows.extent(0) > 0; }
};

}  // namespace railwave
