#pragma once

#include "kernels/nodes.hpp"

namespace railwave {

/// What a step must know of a master segment, in two 16-byte loads.
struct alignas(16) Segment {
  int node[4];       ///< model node numbers, turned outwards
  int neighbour[4];  ///< segment beyond the side eta = -1, xi = 1, eta = 1, xi = -1; -1: the surface ends there
};

/// One contact pair: the slave's nodes against the master's segments (thesis 2.6). Master nodes have a numbering of their
/// own; `master_nodes` and `slave_nodes` lead to the model's.
struct ContactArrays {
  int slave_count = 0, master_count = 0, segment_count = 0;
  double friction = 0;
  bool folded_inwards = false;         ///< the master has sharp inner folds: every step searches anew
  bool folded_outwards = false;        ///< the master has sharp edges, near which several segments hold what has entered
  Array<int*> slave_nodes;
  Array<int*> master_nodes;
  Array<int* [4]> segments;            ///< master node numbers, turned outwards
  Array<int*> first_segment;           ///< master_count + 1
  Array<int*> segment_of_node;         ///< segments around a master node
  Array<Segment*> surface;             ///< the same segments by model node numbers, with their neighbours
  Array<double*> segment_stiffness;    ///< N/m, eq. 2.26d

  /// What the pair does now, by slave node.
  Array<int*> tracked;                 ///< segment that the node was last seen over, touched or not; -1: none yet
  Array<double* [2]> place;            ///< xi, eta on the tracked segment
  Array<int*> status;                  ///< 0: apart, 1: sticks, 2: slips
  Array<double*> gap;                  ///< m, negative: penetration; as old as the last look where the node is far
  Array<double* [3]> normal_force;     ///< N on the slave
  Array<double* [3]> tangential_force; ///< N on the slave
  Array<double*> friction_energy;      ///< J dissipated so far
};

/// A slave node in the window.
struct alignas(16) WindowEntry {
  int slave;  ///< position among the pair's slave nodes
  int node;   ///< model node number
  int near;   ///< 1: it can touch until the next look, and is projected at each step
  int unused;
};

/// Which slave nodes can touch until the window is laid out anew, ascending, and which of them can until the next look.
struct ContactWindow {
  int count = 0;
  Array<WindowEntry*> entries;
  Array<int*> near;        ///< places in `entries`, in any order: what the nodes do does not depend on each other
  Array<int*> near_count;  ///< one
};

inline constexpr int status_apart = 0, status_sticks = 1, status_slips = 2;

/// Bilinear shape functions of a segment, eq. 2.24b.
KOKKOS_INLINE_FUNCTION double segment_shape(int corner, double xi, double eta) {
  const double sign_xi = corner == 1 || corner == 2 ? 1.0 : -1.0;
  const double sign_eta = corner >= 2 ? 1.0 : -1.0;
  return 0.25 * (1.0 + sign_xi * xi) * (1.0 + sign_eta * eta);
}

}  // namespace railwave
