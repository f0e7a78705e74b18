#pragma once

#include "kernels/elements/element_force.hpp"
#include "kernels/nodes/relative_nodes.hpp"

namespace railwave {

/// A block's nodes in scratch memory where they are kept in single precision: displacements are those
/// relative to the co-rotating frame, positions those relative to the block's own point.
template <bool WithVelocity, bool WithMass>
struct StagedNodes<float, WithVelocity, WithMass, RelativeAdvance> {
  float* position;
  float* displacement;
  float* velocity;  ///< m/s, but for that of the block's point, which deforms nothing
  float* inverse_mass;
  int stride;

  static constexpr std::size_t values = 6u + (WithVelocity ? 3u : 0u) + (WithMass ? 1u : 0u);

  static std::size_t scratch_size(int stride) { return sizeof(float) * values * stride + scratch_alignment; }

  template <class Member>
  KOKKOS_INLINE_FUNCTION StagedNodes(const Member& team, int stride_) : stride(stride_) {
    position = scratch_values<float>(team, values * stride);
    displacement = position + 3 * stride;
    velocity = position + 6 * stride;
    inverse_mass = position + (WithVelocity ? 9 : 6) * stride;
  }

  /// The turn that displacements leave out.
  KOKKOS_FORCEINLINE_FUNCTION static const Matrix3<float>& turn(const ElementBlocks& /*blocks*/, int p,
                                                                const RelativeArrays& nodes) {
    return frame_of(nodes, p).turn;
  }

  struct Fetched {
    RelativeNode node;
    float local[3];

    KOKKOS_FORCEINLINE_FUNCTION Fetched(const RelativeArrays& nodes, int n, const float* local_, int stride, int l)
        : node(nodes.node(n)) {
      for (int i = 0; i < 3; ++i) local[i] = local_[i * stride + l];
    }
  };

  template <class Member>
  KOKKOS_INLINE_FUNCTION void bring(const Member& team, const ElementBlocks& blocks, int p,
                                    const RelativeArrays& nodes) const {
    if constexpr (on_device)
      bring_pair(team, NodePair(team, blocks, p), blocks, p, nodes, [] {});
    else
      put_all(blocks.node.data() + static_cast<long>(p) * stride, locals(nodes, p), nodes, frame_of(nodes, p));
  }

  /// See StagedNodes in double precision.
  template <class Member, class Meanwhile>
  KOKKOS_FORCEINLINE_FUNCTION void bring_pair(const Member& /*team*/, const NodePair& pair,
                                              const ElementBlocks& /*blocks*/, int p, const RelativeArrays& nodes,
                                              const Meanwhile& meanwhile) const {
    const float* local = locals(nodes, p);
    const FrameStep& frame = frame_of(nodes, p);
    const Fetched first(nodes, pair.node(0), local, stride, pair.place[0]),
        second(nodes, pair.node(1), local, stride, pair.place[1]);
    meanwhile();
    put(pair.place[0], first, frame);
    put(pair.place[1], second, frame);
  }

  KOKKOS_FORCEINLINE_FUNCTION const float* locals(const RelativeArrays& nodes, int p) const {
    return nodes.local.data() + static_cast<long>(p) * 3 * stride;
  }
  KOKKOS_FORCEINLINE_FUNCTION static const FrameStep& frame_of(const RelativeArrays& nodes, int p) {
    return nodes.frame(nodes.arm(p).frame);
  }

  KOKKOS_FORCEINLINE_FUNCTION void put(int l, const Fetched& fetched, const FrameStep& frame) const {
    float turned[3];
    for (int i = 0; i < 3; ++i)
      turned[i] = product(frame.turn, i, fetched.local[0], fetched.local[1], fetched.local[2]);
    for (int i = 0; i < 3; ++i) {
      displacement[i * stride + l] = fetched.node.displacement[i];
      position[i * stride + l] = turned[i] + fetched.node.displacement[i];
      if constexpr (WithVelocity)
        velocity[i * stride + l] = fetched.node.velocity[i] + product(frame.rate, i, turned[0], turned[1], turned[2]);
    }
    if constexpr (WithMass) inverse_mass[l] = fetched.node.inverse_mass;
  }

  /// The same for all nodes of a host's block: what follows the fetching goes a pack at a time.
  KOKKOS_INLINE_FUNCTION void put_all(const int* number, const float* local, const RelativeArrays& nodes,
                                      const FrameStep& frame) const {
    const int count = stride;
    float *const x = position, *const d = displacement;
    [[maybe_unused]] float* const v = velocity;
    for (int l = 0; l < count; ++l) {
      const RelativeNode node = nodes.node(number[l] & ~advance_bit);
      for (int i = 0; i < 3; ++i) d[i * count + l] = node.displacement[i];
      if constexpr (WithVelocity)
        for (int i = 0; i < 3; ++i) v[i * count + l] = node.velocity[i];
      if constexpr (WithMass) inverse_mass[l] = node.inverse_mass;
    }
    const Matrix3<float> turn = frame.turn;
    [[maybe_unused]] const Matrix3<float> rate = frame.rate;
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#pragma GCC ivdep
#endif
    for (int l = 0; l < count; ++l) {
      float turned[3];
      for (int i = 0; i < 3; ++i) turned[i] = product(turn, i, local[l], local[count + l], local[2 * count + l]);
      for (int i = 0; i < 3; ++i) x[i * count + l] = turned[i] + d[i * count + l];
      if constexpr (WithVelocity)
        for (int i = 0; i < 3; ++i) v[i * count + l] += product(rate, i, turned[0], turned[1], turned[2]);
    }
  }

  /// Nothing: masses are staged.
  KOKKOS_FORCEINLINE_FUNCTION static double missing(const RelativeArrays& /*nodes*/, int /*n*/) { return 0; }

  /// Moves a node under a force, N.
  KOKKOS_FORCEINLINE_FUNCTION void advance(const RelativeAdvance& nodes, int p, int n, int l, const Vector3& force,
                                           double /*missing*/) const {
    const FrameArm origin = nodes.nodes.arm(p);
    const FrameStep& frame = nodes.nodes.frame(origin.frame);
    float a[3], arm[3];
    nodes.acceleration(inverse_mass[l], force, a);
    for (int i = 0; i < 3; ++i)
      arm[i] = product(frame.turn, i, origin.x[0], origin.x[1], origin.x[2]) +
               (position[i * stride + l] - displacement[i * stride + l]);
    // Its velocity is fetched again: what is staged has the frame's in it.
    nodes.move(n, a, frame.change, arm);
  }

  KOKKOS_FORCEINLINE_FUNCTION void modes(const float* component, const BatchCorners<float>& corners,
                                         Pack<float> (&m)[7]) const {
    corner_modes(component, corners, m);
  }
};

/// Moves the nodes that are a block's alone under forces that it has left in the partial ones, to the very bit as
/// ElementForce would have moved them.
struct RelativeBlockUpdate {
  ElementBlocks blocks;
  RelativeAdvance nodes;
  Array<const PartialForce<float>*> partial;
  int first_partial;
  Array<const int*> listed = {};  ///< blocks to move nodes of, one a team; empty: all

  using Staged = StagedNodes<float, false, true, RelativeAdvance>;

  static std::size_t scratch_size(const ElementBlocks& blocks) { return Staged::scratch_size(blocks.node_stride); }

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    const int p = listed.extent(0) > 0 ? listed(team.league_rank()) : team.league_rank();
    const Staged staged(team, blocks.node_stride);
    staged.bring(team, blocks, p, nodes.nodes);
    team.team_barrier();
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, blocks.node_count(p)), [&](const int l) {
      const int place = p * blocks.node_stride + l, n = blocks.node(place);
      if (n >= 0) return;
      const PartialForce<float> f = partial(first_partial + place);
      staged.advance(nodes, p, n & ~advance_bit, l, {{f.x[0], f.x[1], f.x[2]}}, 0);
    });
  }
};

}  // namespace railwave
