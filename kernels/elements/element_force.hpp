#pragma once

#include <type_traits>

#include "kernels/elements/corner_sums.hpp"
#include "kernels/elements/edge_records.hpp"
#include "kernels/elements/hourglass.hpp"
#include "kernels/materials/elastic.hpp"

namespace railwave {

/// What an element kernel asks of a batch's corners, and where it puts their forces, in scratch memory by component.
template <class S, class Staged>
struct StagedBatch {
  using T = Pack<S>;

  const Staged& staged;
  const BatchCorners<S>& corners;
  S* force;  ///< N, with their sign turned; of the batch's first lane

  KOKKOS_FORCEINLINE_FUNCTION void position(int i, T (&m)[7]) const {
    staged.modes(staged.position + i * staged.stride, corners, m);
  }
  KOKKOS_FORCEINLINE_FUNCTION void displacement(int i, T (&m)[7]) const {
    staged.modes(staged.displacement + i * staged.stride, corners, m);
  }
  KOKKOS_FORCEINLINE_FUNCTION void velocity(int i, T (&m)[7]) const {
    staged.modes(staged.velocity + i * staged.stride, corners, m);
  }
  KOKKOS_FORCEINLINE_FUNCTION void put_force(int i, const T (&m)[7]) const {
    T f[8];
    corners_of(m, f);
    for (int N = 0; N < 8; ++N) store(force + i * component_stride + N * elements_of_block, f[N]);
  }
};

/// Step 1 of the thesis's table 2.1, (b) and (c), for one block: internal and hourglass forces of its elements, summed
/// at its nodes: f_i^N = - B_j^N (sigma_ij - sum_M q_iM xm_jM / V) - sum_M q_iM Gamma_M^N. The sums go to `partial`,
/// which the nodes add up in fixed order (nobody waits for anybody, and a run is bitwise the same on any number of
/// threads); nodes that are the block's alone are advanced at once where `Advance` says so.
/// @tparam Nodes how nodes are kept and moved: NodeAdvance or RelativeAdvance
template <class S, class Material, class Hourglass, bool Advance, class Nodes = NodeAdvance>
struct ElementForce {
  using T = Pack<S>;

  Material material;
  ElementBlocks blocks;
  Array<const float*> hourglass_scale;
  Nodes nodes;
  double step;                      ///< s, for the dissipated hourglass energy
  Array<PartialForce<S>*> partial;  ///< N
  int first_partial;                ///< row of the blocks' first node
  Array<const int*> listed = {};    ///< blocks to compute, one a team; empty: all

  using Staged = StagedNodes<S, Hourglass::needs_velocity, Advance, Nodes>;

  /// Whether a block's nodes lie in records.
#ifdef RAILWAVE_SIMD_LANES
  static constexpr bool in_records = std::is_same_v<S, double>;
#else
  static constexpr bool in_records = false;
#endif

  /// Scratch memory of a team, bytes.
  static std::size_t scratch_size(const ElementBlocks& blocks) {
#ifdef RAILWAVE_SIMD_LANES
    if constexpr (in_records)
      return NodeRecords<Hourglass::needs_velocity>::scratch_size(blocks.node_stride) +
             EdgeRecords<Hourglass::needs_velocity>::scratch_size(blocks.edge_stride) + sizeof(S) * elements_of_block +
             scratch_alignment;
#endif
    return Staged::scratch_size(blocks.node_stride) + sizeof(S) * (3u * component_stride + elements_of_block) +
           2 * scratch_alignment +
           (on_device
                ? sizeof(int) * blocks.node_stride + sizeof(std::uint16_t) * blocks.place_stride + 2 * scratch_alignment
                : 0);
  }

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const { run(team, team.league_rank()); }

  /// @param i which of the blocks to compute
  template <class Member>
  KOKKOS_INLINE_FUNCTION void run(const Member& team, const int i) const {
    const int p = listed.extent(0) > 0 ? listed(i) : i;
    if constexpr (in_records)
      run_records(team, p);
    else
      run_staged(team, p);
  }

  template <class Member>
  KOKKOS_INLINE_FUNCTION void run_staged(const Member& team, const int p) const {
    const Staged staged(team, blocks.node_stride);
    S* force = scratch_values<S>(team, 3u * component_stride);
    S* power = scratch_values<S>(team, elements_of_block);
    const int elements = blocks.element_count(p), count = blocks.node_count(p);
    const auto constants = material.template of_block<S>(blocks.material(p), Staged::turn(blocks, p, nodes.nodes));
    if constexpr (on_device) {
      // One element a thread, and two nodes. What is asked of memory waits for nothing but node numbers; what the
      // nodes' sums and motion need is kept in scratch memory, as registers are short.
      int* number = scratch_values<int>(team, blocks.node_stride);
      auto* places = scratch_values<std::uint16_t>(team, blocks.place_stride);
      const int e = team.team_rank();
      const NodePair pair(team, blocks, p);
      const BatchCorners<S> corners = corners_of_batch(p, e);
      const T scale = hourglass_scales(p, e);
      const PlacesOnTheWay on_the_way(team, blocks, p);
      staged.bring_pair(team, pair, blocks, p, nodes.nodes, [&] { on_the_way.put(places); });
      for (int k = 0; k < 2; ++k) number[pair.place[k]] = pair.number[k];
      if (e < 3) force[e * component_stride + zero_place] = 0;
      team.team_barrier();
      if (e < elements) batch_force(p, e, StagedBatch<S, Staged>{staged, corners, force + e}, scale, constants, power);
      team.team_barrier();
      hand_over_pair(team, p, CornerSums(blocks, p, count, places), number, staged, force);
    } else {
      staged.bring(team, blocks, p, nodes.nodes);
      for (int i = 0; i < 3; ++i) force[i * component_stride + zero_place] = 0;
      for (int b = 0; b * lane_count<S> < elements; ++b) {
        const BatchCorners<S> corners = corners_of_batch(p, b);
        batch_force(p, b, StagedBatch<S, Staged>{staged, corners, force + b * lane_count<S>}, hourglass_scales(p, b),
                    constants, power);
      }
      const CornerSums sums(blocks, p, count);
      for (int k = 0; k * lane_count<S> < count; ++k) hand_over_pack(p, k, sums, staged, force);
    }
    add_power(team, p, elements, power);
  }

#ifdef RAILWAVE_SIMD_LANES
  template <class Member>
  void run_records(const Member& team, const int p) const {
    using Records = NodeRecords<Hourglass::needs_velocity>;
    const Records records(team, blocks.node_stride);
    S* power = scratch_values<S>(team, elements_of_block);
    const int elements = blocks.element_count(p), count = blocks.node_count(p);
    const auto constants = material.template of_block<S>(blocks.material(p), Staged::turn(blocks, p, nodes.nodes));
    const int* number = blocks.node.data() + static_cast<long>(p) * blocks.node_stride;
    records.bring(nodes.nodes, number, count);
    if (blocks.edge_stride > 0 && blocks.edge_count(p) > 0)
      run_edges(team, p, elements, records, constants, power);
    else
      run_corners(p, elements, records, constants, power);
    for (int l = 0; l < count; ++l) {
      if (Advance && number[l] < 0) {
        records.advance(nodes, number[l] & ~advance_bit, l);
        continue;
      }
      const double* f = records.sum + 4 * l;
      partial(first_partial + p * blocks.node_stride + l) = {{f[0], f[1], f[2], f[3]}};
    }
    add_power(team, p, elements, power);
  }

  /// Asks memory for the next block's nodes, a share with each group of elements.
  /// @param first element of the group
  KOKKOS_FORCEINLINE_FUNCTION void prefetch_share(const int p, const int first) const {
    constexpr int share = (nodes_of_block * elements_of_group + elements_of_block - 1) / elements_of_block;
    const int count = p + 1 < blocks.count ? blocks.node_count(p + 1) : 0, begin = first / elements_of_group * share;
    NodeRecords<Hourglass::needs_velocity>::prefetch_nodes(
        nodes.nodes, blocks.node.data() + static_cast<long>(p + 1) * blocks.node_stride, begin,
        begin + share < count ? begin + share : count);
  }

  template <class Records, class Constants>
  void run_corners(const int p, const int elements, const Records& records, const Constants& constants,
                   S* power) const {
    constexpr int group = Records::group, parts = group / lane_count<S>;
    const std::uint8_t* corners = blocks.corner.data() + static_cast<long>(p) * elements_of_block * 8;
    for (int first = 0; first < elements; first += group) {
      prefetch_share(p, first);
      typename Records::Batch batch[parts];
      for (int k = 0; k < parts; ++k) batch[k].load(records, corners + (first + k * lane_count<S>)*8);
      for (int k = 0; k < parts; ++k) {
        const int b = first / lane_count<S> + k;
        batch_force(p, b, batch[k], hourglass_scales(p, b), constants, power);
      }
      records.subtract(batch, corners + first * 8, elements - first);
    }
  }

  template <class Member, class Records, class Constants>
  void run_edges(const Member& team, const int p, const int elements, const Records& records,
                 const Constants& constants, S* power) const {
    using Edges = EdgeRecords<Hourglass::needs_velocity>;
    constexpr int group = Records::group;
    const Edges edges(team, blocks.edge_stride);
    const int edge_count = blocks.edge_count(p);
    const std::uint8_t* node = blocks.edge.data() + static_cast<long>(p) * blocks.edge_stride * (2 * group);
    const std::uint8_t* edge_of_group =
        blocks.edge_of_group.data() + static_cast<long>(p) * (elements_of_block / group * 4);
    for (int k = 0; k < edge_count; ++k) edges.make(records, node + 2 * group * k, edges.record + Edges::size * k);
    for (int first = 0; first < elements; first += group) {
      prefetch_share(p, first);
      for (int lane = 0; lane < group; lane += lane_count<S>) {
        typename Edges::Batch batch;
        for (int k = 0; k < 4; ++k)
          batch.edge[k] = edges.record + Edges::size * edge_of_group[first / group * 4 + k] + lane;
        const int b = (first + lane) / lane_count<S>;
        batch_force(p, b, batch, hourglass_scales(p, b), constants, power);
      }
    }
    for (int k = 0; k < edge_count; ++k) edges.subtract(records, node + 2 * group * k, edges.record + Edges::size * k);
  }
#endif

  template <class Member>
  KOKKOS_INLINE_FUNCTION void add_power(const Member& team, const int p, const int elements, const S* power) const {
    if constexpr (!Hourglass::stores)
      Kokkos::parallel_for(Kokkos::TeamThreadRange(team, power_sums), [&](const int k) {
        constexpr int share = elements_of_block / power_sums;
        double sum = 0;
        for (int s = k * share; s < (k + 1) * share && s < elements; ++s) sum += static_cast<double>(power[s]);
        double& energy = blocks.hourglass_energy(p * power_sums + k);
        // Nobody else adds here; on a GPU an atomic addition need not wait for what was there before.
        if constexpr (on_device)
          Kokkos::atomic_add(&energy, step * sum);
        else
          energy += step * sum;
      });
  }

  KOKKOS_INLINE_FUNCTION static int batch_number(int p, int b) { return p * (elements_of_block / lane_count<S>)+b; }

  KOKKOS_INLINE_FUNCTION BatchCorners<S> corners_of_batch(int p, int b) const {
    return BatchCorners<S>(blocks.corner.data() + static_cast<long>(batch_number(p, b)) * 8 * lane_count<S>);
  }

  /// @param batch its corners: StagedBatch or NodeRecords::Batch
  /// @param power_of_slot dissipated by hourglass control, W
  template <class Batch, class Constants>
  KOKKOS_INLINE_FUNCTION void batch_force(const int p, const int b, Batch&& batch, const T& scale,
                                          const Constants& constants, S* power_of_slot) const {
    T x[3][7], B[3][6], H[3][3], cauchy[6];
    for (int i = 0; i < 3; ++i) batch.position(i, x[i]);
    mean_gradient<S>(x, B);
    const T inverse_volume = S(1) / along(x[0], B[0]);
    [[maybe_unused]] T w[3][4];
    for (int i = 0; i < 3; ++i) {
      T u[7];
      batch.displacement(i, u);
      for (int j = 0; j < 3; ++j) H[i][j] = along(u, B[j]) * inverse_volume;
      if constexpr (Hourglass::stores)
        for (int M = 0; M < 4; ++M) w[i][M] = hourglass_content(u, H[i], x, M);
    }
    {
      T e[6];
      almansi_strain<S>(H, e);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) H[i][j] = (i == j ? S(1) : S(0)) - H[i][j];
      material.template stress<S>(constants, batch_number(p, b), H, e, cauchy);
      const T to_cauchy = determinant(H);
      for (int c = 0; c < 6; ++c) cauchy[c] *= to_cauchy;
    }

    // Row by row, so that few values are needed at a time.
    T power = S(0);
    constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int i = 0; i < 3; ++i) {
      T q[4], stress[3], m[7];
      if constexpr (Hourglass::stores) {
        for (int M = 0; M < 4; ++M) q[M] = scale * (H[0][i] * w[0][M] + H[1][i] * w[1][M] + H[2][i] * w[2][M]);
      } else {
        T v[7], L[3];
        batch.velocity(i, v);
        for (int j = 0; j < 3; ++j) L[j] = along(v, B[j]) * inverse_volume;
        for (int M = 0; M < 4; ++M) {
          const T speed = hourglass_content(v, L, x, M);
          q[M] = scale * speed;
          power += q[M] * speed;
        }
      }
      for (int j = 0; j < 3; ++j) {
        const T moment = (q[0] * x[j][3] + q[1] * x[j][4]) + (q[2] * x[j][5] + q[3] * x[j][6]);
        stress[j] = cauchy[voigt[i][j]] - moment * inverse_volume;
      }
      for (int k = 0; k < 6; ++k) m[k] = stress[0] * B[0][k] + stress[1] * B[1][k] + stress[2] * B[2][k];
      for (int M = 0; M < 3; ++M) m[3 + M] += q[M];
      m[6] = q[3];
      batch.put_force(i, m);
    }
    if constexpr (!Hourglass::stores) store(power_of_slot + b * lane_count<S>, power);
  }

  KOKKOS_INLINE_FUNCTION T hourglass_scales(int p, int b) const {
    const float* scales = hourglass_scale.data() + static_cast<long>(batch_number(p, b)) * lane_count<S>;
#ifdef RAILWAVE_SIMD_LANES
    S lanes[lane_count<S>];
    for (int lane = 0; lane < lane_count<S>; ++lane) lanes[lane] = static_cast<S>(scales[lane]);
    return load(lanes);
#else
    return static_cast<S>(*scales);
#endif
  }

  KOKKOS_INLINE_FUNCTION void hand_over_pack(const int p, const int k, const CornerSums& sums, const Staged& staged,
                                             const S* force) const {
    constexpr int lanes = lane_count<S>;
    T sum[3];
    sums.add_up(k, force, sum);
    S lane_sum[3][lanes];
    for (int i = 0; i < 3; ++i) store(lane_sum[i], sum[i]);
    for (int lane = 0; lane < lanes && k * lanes + lane < sums.count; ++lane) {
      const int l = k * lanes + lane;
      hand_over(p, l, blocks.node(p * blocks.node_stride + l), staged,
                {{lane_sum[0][lane], lane_sum[1][lane], lane_sum[2][lane]}}, 0);
    }
  }

  template <class Member>
  KOKKOS_INLINE_FUNCTION void hand_over_pair(const Member& team, const int p, const CornerSums& sums, const int* number,
                                             const Staged& staged, const S* force) const {
    int l[2], n[2];
    bool there[2];
    double missing[2];
    for (int k = 0; k < 2; ++k) {
      l[k] = team.team_rank() + k * team.team_size();
      there[k] = l[k] < sums.count;
      n[k] = there[k] ? number[l[k]] : 0;
      missing[k] = Advance && n[k] < 0 ? Staged::missing(nodes.nodes, n[k] & ~advance_bit) : 0;
    }
    S sum[2][3];
    sums.add_up_pair(l, there, force, sum);
    for (int k = 0; k < 2; ++k)
      if (there[k]) hand_over(p, l[k], n[k], staged, {{sum[k][0], sum[k][1], sum[k][2]}}, missing[k]);
  }

  /// @param n the node, as the block's list has it
  /// @param missing see StagedNodes
  KOKKOS_INLINE_FUNCTION void hand_over(const int p, const int l, const int n, const Staged& staged,
                                        const Vector3& force, const double missing) const {
    if (Advance && n < 0) {
      staged.advance(nodes, p, n & ~advance_bit, l, force, missing);
      return;
    }
    partial(first_partial + p * blocks.node_stride +
            l) = {{static_cast<S>(force[0]), static_cast<S>(force[1]), static_cast<S>(force[2]), S(0)}};
  }
};

/// Stress and energies of a block's elements at the present instant, for outputs and the account.
template <class S, class Material, class Hourglass>
struct ElementState {
  using T = Pack<S>;

  Material material;
  ElementBlocks blocks;
  Array<const float*> hourglass_scale;
  NodeArrays nodes;
  Array<S*> stress;               ///< Cauchy, tiled, 6 values: xx, yy, zz, xy, yz, zx; Pa; not written where empty
  Array<double* [2]> energy;      ///< J, by block: elastic, stored by hourglass control
  Array<const int*> listed = {};  ///< blocks to compute; empty: all. Results are in the list's order then

  using Staged = StagedNodes<S, false, false>;

  static std::size_t scratch_size(const ElementBlocks& blocks) { return Staged::scratch_size(blocks.node_stride); }

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    const int at = team.league_rank(), p = listed.extent(0) > 0 ? listed(at) : at;
    const Staged staged(team, blocks.node_stride);
    staged.bring(team, blocks, p, nodes);
    team.team_barrier();
    const int elements = blocks.element_count(p);
    const int batches = (elements + lane_count<S> - 1) / lane_count<S>;
    double elastic = 0, stored = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, batches),
        [&](const int b, double& sum) { sum += batch_state(p, at, b, elements, staged, 0); }, elastic);
    if constexpr (Hourglass::stores)
      Kokkos::parallel_reduce(
          Kokkos::TeamThreadRange(team, batches),
          [&](const int b, double& sum) { sum += batch_state(p, at, b, elements, staged, 1); }, stored);
    Kokkos::single(Kokkos::PerTeam(team), [&]() {
      energy(at, 0) = elastic;
      energy(at, 1) = stored;
    });
  }

  /// @param at where the block's results go
  /// @param which energy to return: 0 elastic (writes the stress too), 1 stored by hourglass control
  KOKKOS_INLINE_FUNCTION double batch_state(const int p, const int at, const int b, const int elements,
                                            const Staged& staged, const int which) const {
    const int batch = p * (elements_of_block / lane_count<S>)+b;
    const BatchCorners<S> corners(blocks.corner.data() + static_cast<long>(batch) * 8 * lane_count<S>);
    T x[3][7], u[3][7], B[3][6], H[3][3], e[6], tau[6];
    for (int i = 0; i < 3; ++i) {
      staged.modes(staged.position + i * staged.stride, corners, x[i]);
      staged.modes(staged.displacement + i * staged.stride, corners, u[i]);
    }
    mean_gradient<S>(x, B);
    const T volume = along(x[0], B[0]), inverse_volume = S(1) / volume;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) H[i][j] = along(u[i], B[j]) * inverse_volume;
    T value = S(0);
    if (which == 1) {
      for (int i = 0; i < 3; ++i)
        for (int M = 0; M < 4; ++M) {
          const T w = hourglass_content(u[i], H[i], x, M);
          value += w * w;
        }
      const float* scales = hourglass_scale.data() + static_cast<long>(batch) * lane_count<S>;
      return sum_of_elements(value, b, elements, [&](int lane) { return 0.5 * static_cast<double>(scales[lane]); });
    }
    almansi_strain<S>(H, e);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) H[i][j] = (i == j ? S(1) : S(0)) - H[i][j];
    const T to_cauchy = determinant(H);
    const auto constants = material.template of_block<S>(blocks.material(p), Staged::turn(blocks, p, nodes));
    T h[6];
    material.template leave_elastic_part<S>(constants, batch, H, e);
    hencky_strain(e, h);
    kirchhoff_stress<S>(material.elastic(constants), h, tau);
    if (stress.extent(0) != 0)
      for (int c = 0; c < 6; ++c)
        store(stress.data() + tiled<S>(at * (elements_of_block / lane_count<S>)+b, 6, c), T(tau[c] * to_cauchy));
    value = volume * to_cauchy * elastic_energy_density<S>(h, tau);
    return sum_of_elements(value, b, elements, [](int) { return 1.0; });
  }

  template <class Weight>
  KOKKOS_INLINE_FUNCTION static double sum_of_elements(const T& value, int b, int elements, const Weight& weight) {
#ifdef RAILWAVE_SIMD_LANES
    double sum = 0;
    for (int lane = 0; lane < lane_count<S> && b * lane_count<S> + lane < elements; ++lane)
      sum += weight(lane) * static_cast<double>(value[lane]);
    return sum;
#else
    (void)b, (void)elements;
    return weight(0) * static_cast<double>(value);
#endif
  }
};

}  // namespace railwave
