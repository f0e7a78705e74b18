#pragma once

#include "kernels/elastic.hpp"
#include "kernels/lanes.hpp"
#include "kernels/nodes.hpp"
#include "kernels/team.hpp"

namespace railwave {

/// Elements lie in patches: compact groups of at most `patch_size` elements that share at most `patch_nodes` nodes. One
/// team works on a patch: it brings the patch's nodes into scratch memory once, computes its elements from there, and sums
/// the forces of their corners there, so that only what the patch's nodes feel in sum leaves it.
inline constexpr int patch_size = 128;
inline constexpr int patch_nodes = 256;
/// A patch's node that no other patch touches and no load, contact or constraint concerns can be advanced by the patch's
/// own team: its number in the patch's list then carries this bit.
inline constexpr int advance_bit = static_cast<int>(0x80000000u);
/// Corner forces lie in scratch memory component by component; one place after them holds a zero.
inline constexpr int component_stride = 8 * patch_size + 16, zero_place = 8 * patch_size;
/// The power that hourglass control dissipates is added up in so many parts of a patch.
inline constexpr int power_sums = 16;

/// The patches of one group of elements; slot s of patch p is element p patch_size + s. Slots beyond a patch's elements
/// repeat its last one and are gathered by nobody.
struct PatchArrays {
  int count = 0;
  int most_nodes = 0;                  ///< of any patch, a multiple of the pack width
  Array<int*> element_count;
  Array<int*> material;                ///< row of the constants
  Array<int*> first_node;              ///< count + 1: a patch's nodes are node[first_node(p)] ...
  Array<int*> node;                    ///< model node numbers, patch by patch, by how many corners meet there
  Array<int* [3]> frame;               ///< three of a patch's nodes (model numbers) that span a plane
  Array<std::uint8_t*> corner;         ///< by batch: eight places in the patch's nodes, corner by corner
  Array<int*> first_pack;              ///< count + 1: packs of nodes whose corner forces are summed together
  Array<int*> first_place;             ///< by pack, and one more: where its corner places begin
  Array<std::uint16_t*> place;         ///< of the corner forces that meet at the pack's nodes, a pack's lanes together
  Array<float*> hourglass_scale;       ///< by slot: c (kg/s) or k (N/m) of the hourglass control
  Array<float*> settling_hourglass;    ///< by slot, N/m: stiffness control while settling, whatever the run's own control
  Array<double*> hourglass_energy;     ///< power_sums for each patch: J dissipated so far

  KOKKOS_INLINE_FUNCTION int node_number(int k) const { return node(k) & ~advance_bit; }
};

/// A patch's turn: three nodes' frame now against that of the reference.
struct PatchFrame {
  double turn[3][3];
  Vector3 now, before;  ///< m, the patch's first frame node
};

namespace patch {

struct Axes {
  Vector3 a[3];
};

template <class Nodes>
KOKKOS_INLINE_FUNCTION Axes axes_of(const Nodes& x, int n0, int n1, int n2) {
  const Vector3 origin = row(x, n0);
  Vector3 u = row(x, n1) - origin, w = row(x, n2) - origin;
  u = (1 / norm(u)) * u;
  w = w - dot(w, u) * u;
  w = (1 / norm(w)) * w;
  return {{u, w, cross(u, w)}};
}

/// The frame in which single precision measures displacements; in double precision the reference's own will do.
template <class S, class Positions, class References>
KOKKOS_INLINE_FUNCTION PatchFrame frame_of(const PatchArrays& patches, int p, const Positions& position,
                                           const References& reference) {
  PatchFrame frame;
  const int n0 = patches.frame(p, 0);
  frame.now = row(position, n0);
  frame.before = row(reference, n0);
  if constexpr (sizeof(S) < sizeof(double)) {
    const Axes now = axes_of(position, n0, patches.frame(p, 1), patches.frame(p, 2));
    const Axes before = axes_of(reference, n0, patches.frame(p, 1), patches.frame(p, 2));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        frame.turn[i][j] = now.a[0][i] * before.a[0][j] + now.a[1][i] * before.a[1][j] + now.a[2][i] * before.a[2][j];
  }
  return frame;
}

}  // namespace patch

/// A patch's nodes in scratch memory, component by component.
template <class S>
struct StagedNodes {
  S* position;      ///< m, from the patch's frame node
  S* displacement;  ///< m, from the frame's rigid motion
  S* velocity;      ///< m/s; absent where no kernel needs it
  int stride;

  KOKKOS_INLINE_FUNCTION static constexpr std::size_t values(int stride, bool with_velocity) { return (with_velocity ? 9u : 6u) * stride; }

  KOKKOS_INLINE_FUNCTION StagedNodes(S* memory, int stride_)
      : position(memory), displacement(memory + 3 * stride_), velocity(memory + 6 * stride_), stride(stride_) {}

  template <bool WithVelocity, class Member, class Positions, class References, class Velocities>
  KOKKOS_INLINE_FUNCTION void bring(const Member& team, const PatchArrays& patches, int p, const Positions& x,
                                    const References& X, const Velocities& v) const {
    const PatchFrame frame = patch::frame_of<S>(patches, p, x, X);
    const int first = patches.first_node(p), count = patches.first_node(p + 1) - first;
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, count), [&](const int l) {
      const int n = patches.node_number(first + l);
      const Vector3 now = row(x, n) - frame.now, before = row(X, n) - frame.before;
      for (int i = 0; i < 3; ++i) {
        double rigid = before[i];
        if constexpr (sizeof(S) < sizeof(double))
          rigid = frame.turn[i][0] * before[0] + frame.turn[i][1] * before[1] + frame.turn[i][2] * before[2];
        position[i * stride + l] = static_cast<S>(now[i]);
        displacement[i * stride + l] = static_cast<S>(now[i] - rigid);
        if constexpr (WithVelocity) velocity[i * stride + l] = static_cast<S>(v(n, i));
      }
    });
    team.team_barrier();
  }

  /// The modes of one component over a batch's elements.
  KOKKOS_FORCEINLINE_FUNCTION void modes(const S* component, const BatchCorners<S>& corners, Pack<S> (&m)[7]) const {
    Pack<S> u[8];
    for (int N = 0; N < 8; ++N) u[N] = corners.gather(component, N);
    modes_of(u, m);
  }
};

}  // namespace railwave
