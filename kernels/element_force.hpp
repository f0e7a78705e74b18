#pragma once

#include "kernels/elastic.hpp"
#include "kernels/hourglass.hpp"
#include "kernels/lanes.hpp"
#include "kernels/mean_gradient.hpp"

namespace railwave {

/// One set of elements of one material, in tiles; elements that fill up the last tile repeat the set's last one and are
/// gathered by nobody.
struct ElementArrays {
  int element_count = 0;
  int tile_count = 0;
  long force_offset = 0;             ///< where the set's corner forces begin in the model's array
  Array<int*> corners;               ///< tiled, 8 values: node numbers
  Array<double*> hourglass_scale;    ///< tiled, 1 value: c (kg/s) or k (N/m) of the hourglass control
  Array<double*> hourglass_energy;   ///< tiled, 1 value: J, dissipated so far (viscous) or unused

  int batch_count() const { return tile_count * batches_per_tile; }
};

/// Coordinates of a batch's corners.
template <class NodeArray>
KOKKOS_INLINE_FUNCTION void gather_corners(const NodeArray& values, const Array<int*>& corners, int batch,
                                           Real (&u)[3][8]) {
  for (int N = 0; N < 8; ++N) {
    const int* nodes = corners.data() + tiled(batch, 8, N);
    for (int i = 0; i < 3; ++i) u[i][N] = gather(values, nodes, i);
  }
}

/// Step 1 of the thesis's table 2.1, (b) and (c): internal and hourglass force of each element, as the forces on its
/// eight corners, stored for the nodes to gather (no atomics: bitwise the same on any number of threads).
/// f_i^N = - B_j^N (sigma_ij - sum_M q_iM xm_jM / V) - sum_M q_iM Gamma_M^N
template <class Hourglass>
struct ElementForce {
  ElasticConstants constants;
  double step;  ///< s, for the dissipated hourglass energy
  ElementArrays elements;
  Array<const double* [3]> position, reference, velocity;
  Array<double*> corner_force;  ///< tiled, 24 values: corner, direction; N

  KOKKOS_INLINE_FUNCTION void operator()(const int batch) const {
    Real x[3][8], B[3][8], G[3][3], xm[3][4], q[3][4], hourglass_rate;
    gather_corners(position, elements.corners, batch, x);
    mean_gradient(x, B);
    const Real inverse_volume = 1.0 / volume_of(x, B);
    hourglass_moments(x, xm);
    const Real scale = load(elements.hourglass_scale.data() + tiled(batch, 1, 0));
    {
      Real X[3][8];
      gather_corners(reference, elements.corners, batch, X);
      gradient_of(X, B, inverse_volume, G);
      if constexpr (Hourglass::needs_reference) {
        Real Xm[3][4];
        hourglass_moments(X, Xm);
        Hourglass::generalised_force(scale, xm, Xm, G, q, hourglass_rate);
      }
    }
    if constexpr (Hourglass::needs_velocity) {
      Real v[3][8], L[3][3], vm[3][4];
      gather_corners(velocity, elements.corners, batch, v);
      gradient_of(v, B, inverse_volume, L);
      hourglass_moments(v, vm);
      Hourglass::generalised_force(scale, xm, vm, L, q, hourglass_rate);
    }
    if constexpr (Hourglass::dissipates) {
      double* energy = elements.hourglass_energy.data() + tiled(batch, 1, 0);
      store(energy, load(energy) + step * hourglass_rate);
    }

    Real h[6], tau[6], T[3][3];
    hencky_strain(G, h);
    kirchhoff_stress(constants, h, tau);
    const Real to_cauchy = determinant(G);
    constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Real orthogonal = q[i][0] * xm[j][0];
        for (int M = 1; M < 4; ++M) orthogonal += q[i][M] * xm[j][M];
        T[i][j] = tau[voigt[i][j]] * to_cauchy - orthogonal * inverse_volume;
      }

    double* force = corner_force.data() + elements.force_offset;
    for (int i = 0; i < 3; ++i) {
      Real hourglass[8];
      hourglass_at_corners(q[i], hourglass);
      for (int N = 0; N < 8; ++N) {
        const Real f = T[i][0] * B[0][N] + T[i][1] * B[1][N] + T[i][2] * B[2][N] + hourglass[N];
        store(force + tiled(batch, 24, 3 * N + i), -f);
      }
    }
  }
};

/// Cauchy stress (6 values, tiled) and energies of each element at the present instant, for outputs and the account.
template <class Hourglass>
struct ElementState {
  ElasticConstants constants;
  ElementArrays elements;
  Array<const double* [3]> position, reference;
  Array<double*> stress;            ///< tiled, 6 values: xx, yy, zz, xy, yz, zx; Pa
  Array<double*> elastic_energy;    ///< tiled, 1 value, J
  Array<double*> hourglass_energy;  ///< tiled, 1 value, J: stored (stiffness) or dissipated so far (viscous)

  KOKKOS_INLINE_FUNCTION void operator()(const int batch) const {
    Real x[3][8], B[3][8], X[3][8], G[3][3], h[6], tau[6];
    gather_corners(position, elements.corners, batch, x);
    gather_corners(reference, elements.corners, batch, X);
    mean_gradient(x, B);
    const Real volume = volume_of(x, B);
    gradient_of(X, B, Real(1.0 / volume), G);
    hencky_strain(G, h);
    kirchhoff_stress(constants, h, tau);
    const Real to_cauchy = determinant(G);
    for (int c = 0; c < 6; ++c) store(stress.data() + tiled(batch, 6, c), tau[c] * to_cauchy);
    store(elastic_energy.data() + tiled(batch, 1, 0), volume * to_cauchy * elastic_energy_density(h, tau));

    const long at = tiled(batch, 1, 0);
    if constexpr (Hourglass::dissipates) {
      store(hourglass_energy.data() + at, load(elements.hourglass_energy.data() + at));
    } else {
      Real xm[3][4], Xm[3][4], q[3][4], energy;
      hourglass_moments(x, xm);
      hourglass_moments(X, Xm);
      Hourglass::generalised_force(load(elements.hourglass_scale.data() + at), xm, Xm, G, q, energy);
      store(hourglass_energy.data() + at, energy);
    }
  }
};

}  // namespace railwave
