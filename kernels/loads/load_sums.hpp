#pragma once

#include "kernels/support/vector3.hpp"

/// What a sample sums over loads and connectors.
namespace railwave {

struct AmplitudeSum {
  static constexpr int values = 3;
  Array<const double* [3]> amplitude;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const {
    for (int k = 0; k < 3; ++k) sum[k] += amplitude(i, k);
  }
};

/// Area of facets along the outward normal, as they lie now (thesis eq. 2.18, one point).
struct FacetSum {
  static constexpr int values = 3;
  Array<const double* [3]> position;
  Array<const int* [4]> facets;
  KOKKOS_INLINE_FUNCTION void operator()(int f, double* sum) const {
    const Vector3 p0 = row(position, facets(f, 0)), p1 = row(position, facets(f, 1));
    const Vector3 p2 = row(position, facets(f, 2)), p3 = row(position, facets(f, 3));
    const Vector3 area = 0.5 * cross(p2 - p0, p3 - p1);
    for (int k = 0; k < 3; ++k) sum[k] += area[k];
  }
};

/// Stored in connectors' springs, and dissipated in their dashpots.
struct ConnectorEnergy {
  static constexpr int values = 2;
  Array<const double* [2]> energy;
  KOKKOS_INLINE_FUNCTION void operator()(int c, double* sum) const {
    for (int k = 0; k < values; ++k) sum[k] += energy(c, k);
  }
};

}  // namespace railwave
