#pragma once

#include <cmath>

#include "kernels/elements/damping_arrays.hpp"
#include "kernels/elements/element_modes.hpp"
#include "kernels/nodes/relative_blocks.hpp"
#include "kernels/support/lane_choice.hpp"

namespace railwave {

template <class T>
KOKKOS_FORCEINLINE_FUNCTION T cube_root(const T& value) {
  using std::cbrt;
  return T(cbrt(value));
}

/// Velocity of a node half a step back, m/s; n is its number, l its place in block p.
template <class Staged>
KOKKOS_FORCEINLINE_FUNCTION Vector3 velocity_of(const Staged& /*staged*/, const NodeArrays& nodes, int /*p*/, int n,
                                                int /*l*/) {
  return row(nodes.velocity, n);
}

template <class Staged>
KOKKOS_FORCEINLINE_FUNCTION Vector3 velocity_of(const Staged& staged, const RelativeArrays& nodes, int p, int n,
                                                int l) {
  const FrameArm origin = nodes.arm(p);
  const FrameStep& frame = nodes.frame(origin.frame);
  float arm[3];
  for (int i = 0; i < 3; ++i)
    arm[i] = product(frame.turn, i, origin.x[0], origin.x[1], origin.x[2]) +
             (staged.position[i * staged.stride + l] - staged.displacement[i * staged.stride + l]);
  Vector3 v;
  for (int i = 0; i < 3; ++i)
    v[i] = frame.next.velocity[i] +
           static_cast<double>(product(frame.rate, i, arm[0], arm[1], arm[2]) + nodes.node(n).velocity[i]);
  return v;
}

/// Damping forces of one block's elements, with the velocities half a step back:
///   sigma = beta (lambda tr(d) I + 2 mu d) - q I,  d the rate of strain,
///   q = rho l (Q1 l tr(d)^2 - Q2 c tr(d)) where tr(d) < 0, l = V^(1/3)   (Neumann and Richtmyer 1950; Landshoff
///   1955),
/// by the mean gradient, and - alpha m v on the nodes, alpha being the part's and that of absorbing layers there.
/// Hourglass modes have their own control. Forces go to rows of the partial ones beside those of the elements'
/// stresses, so that damped elements are computed by the same kernels as others. What is dissipated is the forces' work
/// by the trapezoidal rule, from what the rows still hold of the instant before.
template <class S, class Nodes>
struct BlockDamping {
  using T = Pack<S>;
  using Staged = StagedNodes<S, true, false, Nodes>;

  DampingArrays damping;
  ElementBlocks blocks;
  Nodes nodes;
  double elapsed;                   ///< s since the forces in the rows; 0: there are none yet
  double share_before;              ///< of the rows' forces to book now: 1, or 0 where BookDamping has done it
  Array<PartialForce<S>*> partial;  ///< N
  Array<const int*> listed = {};    ///< blocks to compute, one a team; empty: all

  static std::size_t scratch_size(const ElementBlocks& blocks) {
    return Staged::scratch_size(blocks.node_stride) + sizeof(S) * 3u * component_stride + 2 * scratch_alignment;
  }

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    const int p = listed.extent(0) > 0 ? listed(team.league_rank()) : team.league_rank();
    const Staged staged(team, blocks.node_stride);
    S* force = scratch_values<S>(team, 3u * component_stride);
    staged.bring(team, blocks, p, nodes.nodes);
    if (team.team_rank() == 0)
      for (int i = 0; i < 3; ++i) force[i * component_stride + zero_place] = 0;
    team.team_barrier();
    const DampingConstants constants = damping.constants(blocks.material(p));
    const int batches = (blocks.element_count(p) + lane_count<S> - 1) / lane_count<S>;
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, batches),
                         [&](const int b) { batch_force(p, b, constants, staged, force); });
    team.team_barrier();
    const CornerSums sums(blocks, p, blocks.node_count(p));
    const int packs = (sums.count + lane_count<S> - 1) / lane_count<S>;
    double dissipated = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, packs),
        [&](const int k, double& sum) { sum += hand_over(p, k, sums, staged, force); }, dissipated);
    Kokkos::single(Kokkos::PerTeam(team), [&]() { damping.energy(p) += dissipated; });
  }

  /// @param force corner forces with their sign turned, N
  KOKKOS_INLINE_FUNCTION void batch_force(const int p, const int b, const DampingConstants& constants,
                                          const Staged& staged, S* force) const {
    const BatchCorners<S> corners(blocks.corner.data() +
                                  static_cast<long>(p * (elements_of_block / lane_count<S>)+b) * 8 * lane_count<S>);
    T x[3][7], B[3][6], L[3][3];
    for (int i = 0; i < 3; ++i) staged.modes(staged.position + i * staged.stride, corners, x[i]);
    mean_gradient<S>(x, B);
    const T volume = along(x[0], B[0]), inverse_volume = S(1) / volume;
    for (int i = 0; i < 3; ++i) {
      T v[7];
      staged.modes(staged.velocity + i * staged.stride, corners, v);
      for (int j = 0; j < 3; ++j) L[i][j] = along(v, B[j]) * inverse_volume;
    }
    const T growth = L[0][0] + L[1][1] + L[2][2];
    T spherical = S(constants.lambda) * growth;
    if (constants.linear > 0 || constants.quadratic > 0) {
      const T length = cube_root(volume), shrinking = choose(growth < S(0), growth, T(S(0)));
      spherical += length * shrinking * (S(constants.linear) - S(constants.quadratic) * length * shrinking);
    }
    for (int i = 0; i < 3; ++i) {
      T stress[3], m[7], f[8];
      for (int j = 0; j < 3; ++j) stress[j] = S(constants.mu) * (L[i][j] + L[j][i]);
      stress[i] += spherical;
      for (int k = 0; k < 6; ++k) m[k] = stress[0] * B[0][k] + stress[1] * B[1][k] + stress[2] * B[2][k];
      m[6] = S(0);
      corners_of(m, f);
      for (int N = 0; N < 8; ++N) store(force + i * component_stride + N * elements_of_block + b * lane_count<S>, f[N]);
    }
  }

  /// Sums the corners at a pack of nodes; returns what they have dissipated since the instant before, J.
  KOKKOS_INLINE_FUNCTION double hand_over(const int p, const int k, const CornerSums& sums, const Staged& staged,
                                          const S* force) const {
    constexpr int lanes = lane_count<S>;
    T sum[3];
    sums.add_up(k, force, sum);
    S lane_sum[3][lanes];
    for (int i = 0; i < 3; ++i) store(lane_sum[i], sum[i]);
    double dissipated = 0;
    for (int lane = 0; lane < lanes && k * lanes + lane < sums.count; ++lane) {
      const int l = k * lanes + lane, at = p * blocks.node_stride + l;
      const Vector3 v = velocity_of(staged, nodes.nodes, p, blocks.node(at) & ~advance_bit, l);
      const double drag = damping.node_drag(at);
      const PartialForce<S> before = partial(damping.first_partial + at);
      PartialForce<S> now{};
      for (int i = 0; i < 3; ++i) {
        now.x[i] = static_cast<S>(lane_sum[i][lane] - drag * v[i]);
        dissipated -=
            0.5 * elapsed * (share_before * static_cast<double>(before.x[i]) + static_cast<double>(now.x[i])) * v[i];
      }
      partial(damping.first_partial + at) = now;
    }
    return dissipated;
  }
};

/// Of elements evaluated every so many steps: books the half of the forces' work that they do after their evaluation,
/// one step later, when nodes of a finer level still have the velocity that followed it.
template <class S>
struct BookDamping {
  DampingArrays damping;
  ElementBlocks blocks;
  Array<const double* [3]> velocity;
  double half_time;                       ///< s, half of what the forces act for
  Array<const PartialForce<S>*> partial;  ///< N

  KOKKOS_INLINE_FUNCTION void operator()(const int p) const {
    double work = 0;
    for (int l = 0; l < blocks.node_count(p); ++l) {
      const int at = p * blocks.node_stride + l;
      const PartialForce<S> f = partial(damping.first_partial + at);
      const Vector3 v = row(velocity, blocks.node(at) & ~advance_bit);
      for (int i = 0; i < 3; ++i) work += static_cast<double>(f.x[i]) * v[i];
    }
    damping.energy(p) -= half_time * work;
  }
};

}  // namespace railwave
