#pragma once

#include "kernels/nodes.hpp"

namespace railwave {

/// One contact pair: the slave's nodes against the master's segments (thesis 2.6). Master nodes and segments have a
/// numbering of their own; `master_nodes` and `slave_nodes` lead to the model's.
struct ContactArrays {
  int slave_count = 0, master_count = 0, segment_count = 0;
  double friction = 0;
  Array<int*> slave_nodes;
  Array<int*> master_nodes;
  Array<int* [4]> segments;            ///< master node numbers, turned outwards
  Array<int*> first_segment;           ///< master_count + 1
  Array<int*> segment_of_node;         ///< segments around a master node
  Array<double*> segment_stiffness;    ///< N/m, eq. 2.26d

  /// What the pair does now, by slave node.
  Array<int*> closest;                 ///< master node, tracked from step to step
  Array<int*> segment;                 ///< touched, -1: none
  Array<double* [2]> place;            ///< xi, eta on that segment
  Array<double*> gap;                  ///< m, negative: penetration
  Array<double* [3]> normal_force;     ///< N on the slave
  Array<double* [3]> tangential_force; ///< N on the slave
  Array<int*> status;                  ///< 0: apart, 1: sticks, 2: slips
  Array<double*> friction_energy;      ///< J dissipated so far
  Array<double* [3]> master_force;     ///< N, by master node
};

/// Which nodes can touch until the window is laid out anew.
struct ContactWindow {
  int slave_count = 0, master_count = 0;
  Array<int*> slaves;       ///< positions among the pair's slave nodes, ascending
  Array<int*> masters;      ///< master nodes that those slaves can load
  Array<int*> first;        ///< master_count + 1
  Array<int*> candidates;   ///< slaves that can touch a segment around the master node, ascending
};

inline constexpr int status_apart = 0, status_sticks = 1, status_slips = 2;

/// Bilinear shape functions of a segment, eq. 2.24b.
KOKKOS_INLINE_FUNCTION double segment_shape(int corner, double xi, double eta) {
  const double sign_xi = corner == 1 || corner == 2 ? 1.0 : -1.0;
  const double sign_eta = corner >= 2 ? 1.0 : -1.0;
  return 0.25 * (1.0 + sign_xi * xi) * (1.0 + sign_eta * eta);
}

/// r(xi, eta) on a segment, eq. 2.24.
KOKKOS_INLINE_FUNCTION Vector3 segment_point(const Vector3 (&corner)[4], double xi, double eta) {
  Vector3 r{{0, 0, 0}};
  for (int k = 0; k < 4; ++k) r = r + segment_shape(k, xi, eta) * corner[k];
  return r;
}

}  // namespace railwave
