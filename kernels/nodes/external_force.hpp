#pragma once

#include "kernels/nodes/nodes.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave {

/// One of a row's contributions.
struct alignas(16) RowShare {
  int contribution;
  int law;        ///< `given`, or a connector's number, or the number of connectors plus that of a torque
  double weight;  ///< of the node in its set; negative at a connector's `from`

  static constexpr int given = -1;  ///< its load's own kernel has put its value in place
};

/// A row with contributions: shares(first) ... shares(last - 1), in fixed order.
struct alignas(16) LoadedRow {
  int row, node, first, last;
};

/// External and contact forces, which few nodes feel: those of loads and connectors are contributions, gathered by row
/// in fixed order; contact adds to its part of the sum in whole quanta.
struct ExternalForces {
  int row_count = 0;  ///< nodes that can feel any of them
  int contribution_count = 0, loaded_count = 0;
  ExternalForceSum sum;
  Array<LoadedRow*> loaded;
  Array<int*> loaded_of_row;  ///< place among the loaded rows, -1: the row has no contributions
  Array<RowShare*> shares;
  Array<double* [3]> contribution;  ///< N
  Array<int*> contribution_node;
  Array<double*> work;  ///< J, done so far by each contribution
};

/// Puts a load's new value in place and books the work done since the last step, by the trapezoidal rule over the
/// motion from t_(n-1) to t_n; `elapsed` is zero at a run's first step, when nothing has moved yet.
/// @param n its node
KOKKOS_INLINE_FUNCTION void set_contribution(const ExternalForces& external, const Array<const double* [3]>& velocity,
                                             int c, int n, const Vector3& now, double elapsed) {
  const Vector3 before = row(external.contribution, c);
  external.work(c) += 0.5 * elapsed * dot(before + now, row(velocity, n));
  for (int i = 0; i < 3; ++i) external.contribution(c, i) = now[i];
}

KOKKOS_INLINE_FUNCTION void set_contribution(const ExternalForces& external, const Array<const double* [3]>& velocity,
                                             int c, const Vector3& now, double elapsed) {
  set_contribution(external, velocity, c, external.contribution_node(c), now, elapsed);
}

/// Forces of fixed direction (nodal forces, tractions on the reference area) times a curve's value.
struct DeadLoad {
  ExternalForces external;
  Array<const double* [3]> velocity;
  int first;                           ///< its contributions are first, first + 1, ...
  Array<const double* [3]> amplitude;  ///< N, one for each
  StepValue<double> factor;
  double elapsed;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    set_contribution(external, velocity, first + i, factor() * row(amplitude, i), elapsed);
  }
};

/// Pressure on facets that follows the surface: one-point quadrature (thesis eq. 2.18), a quarter on each corner.
/// Contributions 4 f to 4 f + 3 belong to facet f.
struct PressureLoad {
  ExternalForces external;
  Array<const double*[3]> position, velocity;
  int first;
  Array<const int* [4]> facets;  ///< node numbers, turned outwards
  StepValue<double> pressure;    ///< Pa, positive pushes into the body
  double elapsed;
  KOKKOS_INLINE_FUNCTION void operator()(const int f) const {
    const Vector3 p0 = row(position, facets(f, 0)), p1 = row(position, facets(f, 1));
    const Vector3 p2 = row(position, facets(f, 2)), p3 = row(position, facets(f, 3));
    const Vector3 quarter = (-pressure() * 0.125) * cross(p2 - p0, p3 - p1);
    for (int k = 0; k < 4; ++k) set_contribution(external, velocity, first + 4 * f + k, quarter, elapsed);
  }
};

}  // namespace railwave
