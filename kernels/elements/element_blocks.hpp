#pragma once

#include "kernels/elements/element_modes.hpp"
#include "kernels/nodes/nodes.hpp"
#include "kernels/support/lanes.hpp"
#include "kernels/support/team.hpp"

namespace railwave {

/// Elements lie in blocks: compact groups of at most `elements_of_block` elements that share at most `nodes_of_block`
/// nodes. One team works on a block: it brings the block's nodes into scratch memory once, computes its elements from
/// there, and sums the forces of their corners there, so that only what the block's nodes feel in sum leaves it.
inline constexpr int elements_of_block = 128;
/// Rooms for a block's nodes are multiples of this.
inline constexpr int node_room = 16;
/// A team's scratch memory holds nine values and the number of each node, the corner forces and where they lie, a value
/// of each element, and what Kokkos keeps there: 48 KiB at most, which any GPU has. A byte numbers the nodes.
inline constexpr int nodes_of_block = 240;
/// A block's node that no other block touches and no load, contact or constraint concerns can be advanced by the
/// block's own team: its number in the block's list then carries this bit.
inline constexpr int advance_bit = static_cast<int>(0x80000000u);
/// Corner forces lie in scratch memory component by component; one place after them holds a zero, for nodes where fewer
/// corners meet than are added up at once.
inline constexpr int component_stride = 8 * elements_of_block + (on_device ? 2 : 16),
                     zero_place = 8 * elements_of_block;
/// The power that hourglass control dissipates is added up in so many parts of a block.
inline constexpr int power_sums = 16;

/// Place numbers in 16 bytes, which a thread reads at once.
inline constexpr int places_at_once = 8;
/// So many corner forces of a node are added up at once by a thread of a device.
inline constexpr int corners_at_once = 4;
/// Each node has at least one corner, and its last few may have fewer than are added up at once.
inline constexpr int most_places = 8 * elements_of_block + (corners_at_once - 1) * nodes_of_block;
static_assert(nodes_of_block % node_room == 0 && nodes_of_block * (9 * 8 + 4) +
                                                         8 * (3 * component_stride + elements_of_block) +
                                                         2 * most_places + 8 * (elements_of_block + 2) + 6 * 16 <=
                                                     48 * 1024,
              "the scratch memory of a team is too small");

/// So many elements, of consecutive slots, are a group of a host's, whatever the lanes of a pack there: results are the
/// same then on any processor.
inline constexpr int elements_of_group = 8;

/// The rigid motion from which single precision measures a block's displacements: u = (x - now) - turn (X - before).
/// Any turn and any point near the block's own will do, so the frames are renewed only now and then; what they take out
/// is what would cost digits.
struct BlockFrame {
  static constexpr int values = 15;  ///< turn by rows, now, before (m)
  const double* value;

  KOKKOS_FORCEINLINE_FUNCTION double now(int i) const { return value[9 + i]; }
  KOKKOS_FORCEINLINE_FUNCTION Vector3 turned(const Vector3& X) const {
    const Vector3 arm{{X[0] - value[12], X[1] - value[13], X[2] - value[14]}};
    Vector3 result;
    for (int i = 0; i < 3; ++i)
      result[i] = value[3 * i] * arm[0] + value[3 * i + 1] * arm[1] + value[3 * i + 2] * arm[2];
    return result;
  }
};

/// The blocks of one group of elements; slot s of block p is element p elements_of_block + s. Slots beyond a block's
/// elements repeat its last one and are gathered by nobody. Lists have the same length for every block, so that a team
/// finds its own without looking up where they begin.
struct ElementBlocks {
  int count = 0;
  int node_stride = 0;   ///< room for the nodes of any block, a multiple of the pack width
  int first_stride = 0;  ///< room for first_place
  int place_stride = 0;  ///< room for the corner places
  Array<int*> element_count;
  Array<int*> node_count;
  Array<int*> material;        ///< row of the constants
  Array<int*> node;            ///< node_stride for each block: model node numbers, by how many corners meet there (see
                               ///< block_nodes.hpp); filled up with the block's first
  Array<int* [3]> frame_node;  ///< three of a block's nodes (model numbers) that span a plane
  Array<double * [BlockFrame::values]> frame;  ///< empty in double precision
  Array<std::uint8_t*> corner;                 ///< by batch: eight places in the block's nodes, corner by corner
  Array<std::uint16_t*> first_place;           ///< first_stride for each block, see CornerSums
  Array<std::uint16_t*> place;  ///< place_stride for each block: where the corner forces lie that meet at its nodes
  /// On a host in double precision: an edge group are the edges at the same place in the elements of a group, for the
  /// four places along one of the elements' directions. Groups of elements that are neighbours share them. A block for
  /// whose elements that spares little has none.
  int edge_stride = 0;        ///< room for the edge groups of any block
  Array<int*> edge_count;     ///< edge groups of each block
  Array<std::uint8_t*> edge;  ///< 2 elements_of_group for each edge group: places of the edges' nodes, lower xi first
  Array<std::uint8_t*> edge_of_group;  ///< four edge groups for each group of elements
  Array<float*> hourglass_scale;       ///< by slot: c (kg/s) or k (N/m) of the hourglass control
  Array<float*> settling_hourglass;  ///< by slot, N/m: stiffness control while settling, whatever the run's own control
  Array<double*> hourglass_energy;   ///< power_sums for each block: J dissipated so far
};

/// The turn that a block's frame takes out, by rows.
struct FrameTurn {
  const ElementBlocks& blocks;
  int p;

  KOKKOS_FORCEINLINE_FUNCTION double operator()(int i, int j) const { return blocks.frame(p, 3 * i + j); }
};

/// Updates the frames, which lie along three of each block's nodes as they stand now.
struct RenewFrames {
  ElementBlocks blocks;
  Array<const double*[3]> position, reference;

  struct Axes {
    Vector3 a[3];
  };

  KOKKOS_INLINE_FUNCTION Axes axes(const Array<const double* [3]>& x, int p) const {
    const Vector3 origin = row(x, blocks.frame_node(p, 0));
    Vector3 u = row(x, blocks.frame_node(p, 1)) - origin, w = row(x, blocks.frame_node(p, 2)) - origin;
    u = (1 / norm(u)) * u;
    w = w - dot(w, u) * u;
    w = (1 / norm(w)) * w;
    return {{u, w, cross(u, w)}};
  }

  KOKKOS_INLINE_FUNCTION void operator()(const int p) const {
    const Axes now = axes(position, p), before = axes(reference, p);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        blocks.frame(p, 3 * i + j) =
            now.a[0][i] * before.a[0][j] + now.a[1][i] * before.a[1][j] + now.a[2][i] * before.a[2][j];
      blocks.frame(p, 9 + i) = position(blocks.frame_node(p, 0), i);
      blocks.frame(p, 12 + i) = reference(blocks.frame_node(p, 0), i);
    }
  }
};

/// The modes of one component over a batch's elements.
template <class S>
KOKKOS_FORCEINLINE_FUNCTION void corner_modes(const S* component, const BatchCorners<S>& corners, Pack<S> (&m)[7]) {
  Pack<S> u[8];
  for (int N = 0; N < 8; ++N) u[N] = corners.gather(component, N);
  modes_of(u, m);
}

/// The two of a block's nodes that a thread of a device brings, and whose forces it adds up: what the second asks of
/// memory is under way while the first waits.
struct NodePair {
  int place[2];   ///< in the block's list; those of threads beyond its room are again the last
  int number[2];  ///< as the list has them

  template <class Member>
  KOKKOS_FORCEINLINE_FUNCTION NodePair(const Member& team, const ElementBlocks& blocks, int p) {
    static_assert(nodes_of_block <= 2 * elements_of_block, "a thread brings two nodes");
    const int last = blocks.node_stride - 1;
    const int* numbers = blocks.node.data() + static_cast<long>(p) * blocks.node_stride;
    for (int k = 0; k < 2; ++k) {
      const int l = team.team_rank() + k * team.team_size();
      place[k] = l < last ? l : last;
    }
    for (int k = 0; k < 2; ++k) number[k] = numbers[place[k]];
  }

  KOKKOS_FORCEINLINE_FUNCTION int node(int k) const { return number[k] & ~advance_bit; }
};

/// A block's nodes in scratch memory, component by component.
/// @tparam Nodes what moves them: NodeAdvance, or RelativeAdvance where nodes are in single precision
/// (relative_blocks.hpp)
template <class S, bool WithVelocity, bool WithMass, class Nodes = NodeAdvance>
struct StagedNodes {
  S* position;           ///< m; in single precision from the frame's point
  S* displacement;       ///< m, from the reference, in single precision from the frame's rigid motion
  S* velocity;           ///< m/s
  double* inverse_mass;  ///< 1/kg, on a host; a device has no room for it
  double* frame;         ///< of BlockFrame, in single precision
  int stride;
  static constexpr bool in_single = sizeof(S) < sizeof(double), mass_staged = WithMass && !on_device;

  static std::size_t scratch_size(int stride) {
    return sizeof(S) * (WithVelocity ? 9u : 6u) * stride + (mass_staged ? sizeof(double) * stride : 0) +
           (in_single ? sizeof(double) * BlockFrame::values : 0) + 3 * scratch_alignment;
  }

  template <class Member>
  KOKKOS_INLINE_FUNCTION StagedNodes(const Member& team, int stride_) : stride(stride_) {
    inverse_mass = mass_staged ? scratch_values<double>(team, stride) : nullptr;
    frame = in_single ? scratch_values<double>(team, BlockFrame::values) : nullptr;
    position = scratch_values<S>(team, (WithVelocity ? 9u : 6u) * stride);
    displacement = position + 3 * stride;
    velocity = position + 6 * stride;
  }

  template <class Member>
  KOKKOS_INLINE_FUNCTION void bring(const Member& team, const ElementBlocks& blocks, int p,
                                    const NodeArrays& nodes) const {
    if constexpr (on_device) {
      bring_pair(team, NodePair(team, blocks, p), blocks, p, nodes, [] {});
    } else {
      if constexpr (in_single) bring_frame(team, blocks, p);
      const int* number = blocks.node.data() + static_cast<long>(p) * stride;
      for (int l = 0; l < stride; ++l) put(l, Fetched(nodes, number[l] & ~advance_bit));
    }
  }

  /// @param meanwhile done when memory has been asked for the nodes
  template <class Member, class Meanwhile>
  KOKKOS_FORCEINLINE_FUNCTION void bring_pair(const Member& team, const NodePair& pair, const ElementBlocks& blocks,
                                              int p, const NodeArrays& nodes, const Meanwhile& meanwhile) const {
    if constexpr (in_single) bring_frame(team, blocks, p);
    const Fetched first(nodes, pair.node(0)), second(nodes, pair.node(1));
    meanwhile();
    if constexpr (in_single) team.team_barrier();
    put(pair.place[0], first);
    put(pair.place[1], second);
  }

  template <class Member>
  KOKKOS_INLINE_FUNCTION void bring_frame(const Member& team, const ElementBlocks& blocks, int p) const {
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, BlockFrame::values),
                         [&](const int k) { frame[k] = blocks.frame(p, k); });
  }

  /// The turn that displacements leave out, in single precision.
  KOKKOS_FORCEINLINE_FUNCTION static FrameTurn turn(const ElementBlocks& blocks, int p, const NodeArrays& /*nodes*/) {
    return {blocks, p};
  }

  struct Fetched {
    Vector3 now, before, velocity;
    double mass;

    KOKKOS_FORCEINLINE_FUNCTION Fetched(const NodeArrays& nodes, int n)
        : now(row(nodes.position, n)), before(row(nodes.reference, n)) {
      if constexpr (WithVelocity) velocity = row(nodes.velocity, n);
      if constexpr (mass_staged) mass = nodes.mass(n);
    }
  };

  KOKKOS_FORCEINLINE_FUNCTION void put(int l, const Fetched& node) const {
    Vector3 now = node.now, before = node.before;
    if constexpr (WithVelocity)
      for (int i = 0; i < 3; ++i) velocity[i * stride + l] = static_cast<S>(node.velocity[i]);
    if constexpr (mass_staged) inverse_mass[l] = 1.0 / node.mass;
    if constexpr (in_single) {
      const BlockFrame motion{frame};
      for (int i = 0; i < 3; ++i) now[i] -= motion.now(i);
      before = motion.turned(before);
    }
    for (int i = 0; i < 3; ++i) {
      position[i * stride + l] = static_cast<S>(now[i]);
      displacement[i * stride + l] = static_cast<S>(now[i] - before[i]);
    }
  }

  /// What a node's motion needs that is not staged, kg: asked of memory before forces are added up, it comes meanwhile.
  KOKKOS_FORCEINLINE_FUNCTION static double missing(const NodeArrays& nodes, int n) {
    return WithMass && !mass_staged ? nodes.mass(n) : 0;
  }

  /// Moves a node under a force, N; what is staged in full precision need not be fetched again.
  /// @param mass of missing()
  KOKKOS_FORCEINLINE_FUNCTION void advance(const NodeAdvance& nodes, int /*p*/, int n, int l, const Vector3& force,
                                           double mass) const {
    const Vector3 a = nodes.acceleration(mass_staged ? inverse_mass[l] : 1.0 / mass, force);
    if constexpr (!in_single && WithVelocity)
      nodes.move(n, a, {{position[l], position[stride + l], position[2 * stride + l]}},
                 {{velocity[l], velocity[stride + l], velocity[2 * stride + l]}});
    else
      nodes.move(n, a);
  }

  KOKKOS_FORCEINLINE_FUNCTION void modes(const S* component, const BatchCorners<S>& corners, Pack<S> (&m)[7]) const {
    corner_modes(component, corners, m);
  }
};

}  // namespace railwave
