#pragma once

#include <cstdint>

#include "kernels/nodes/nodes.hpp"

namespace railwave {

inline constexpr int nodes_of_multiplier = 5;               ///< the slave's and the four of the segment
inline constexpr int most_nodes_of_multiplier = 1 + 4 * 3;  ///< where all corners are at mouths, see MouthCorner

/// A node that multipliers move, and what it does in the step as long as they stay those of the last one.
struct alignas(16) FreeNode {
  Vector3 predicted;  ///< m, its movement
  double compliance;  ///< m/N, of FreeMotion
  double together;    ///< m/N, the same times how many multipliers push it, each counted by its weight
  int constraint;     ///< row in the constraint table, -1: free
  int unused;
};

/// The nodes that multipliers of any contact pair move, by row of the external forces.
struct FreeNodeArrays {
  Array<SharedNode*> shared;            ///< which nodes they are, and where elements' forces on them lie
  Array<FreeNode*> nodes;               ///< those that are listed hold in a step
  Array<std::uint64_t*> multiplicity;   ///< sum of weights of the multipliers that push it, in whole quanta; zero
                                        ///< between steps. Kokkos knows 64-bit atomics by this type alone
  Array<std::uint64_t* [2][3]> change;  ///< force handed to it in this step, in quanta of ExternalForceSum: after
                                        ///< the sweeps of even numbers, and of odd ones
  Array<int*> listed;                   ///< rows of the nodes that are pushed, each once, in any order
  Array<int*> listed_count;             ///< one; zero between steps
};

/// What a slave node's multiplier needs in a step.
struct alignas(16) MultiplierRow {
  int slave;  ///< position among the pair's slave nodes
  int node;   ///< of the model
  int slips;
  int active;
  Vector3 normal;
  Vector3 free;       ///< m, movement of the slave over the master's material in the step with the last step's forces
  Vector3 force;      ///< N on the slave, so far
  Vector3 begun;      ///< N, the last step's
  Vector3 change;     ///< N, of the last sweep
  Vector3 moved;      ///< m, over the master's material since the step before
  double pressing;    ///< N, normal part of `force`
  double friction;    ///< coefficient
  double gap;         ///< m
  double closing;     ///< m, by how much the gap is to close in the step, at most where nothing presses yet
  double compliance;  ///< m/N, no less than what all multipliers together can move this node against the master
  int count;          ///< of nodes
  int row[most_nodes_of_multiplier];        ///< of the external forces: the slave's and the segment's nodes
  double weight[most_nodes_of_multiplier];  ///< 1, and minus the shape functions
};

struct MultiplierArrays {
  Array<MultiplierRow*> rows;            ///< of near nodes, in their order; they hold in a step
  Array<double* [3]> way_since_stuck;    ///< m, by slave
  int most_nodes = nodes_of_multiplier;  ///< of a row
  Array<double*> impact_energy;          ///< J, by slave: what normal forces have taken out of the bodies so far
  bool active() const { return rows.extent(0) > 0; }
};

}  // namespace railwave
