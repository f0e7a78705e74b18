#pragma once

#include "kernels/contact/laws/growing_penalty.hpp"
#include "kernels/nodes/nodes.hpp"

namespace railwave {

/// What a step must know of a master segment, in two 16-byte loads. Its sides are eta = -1, xi = 1, eta = 1, xi = -1.
struct alignas(16) Segment {
  int node[4];  ///< corners, turned outwards: model node numbers, or -1 - the number of a MouthCorner
  int link[4];  ///< by side: the segment beyond it, marked where the surface folds; -1: the surface ends there

  static constexpr int over_fold = 1 << 30;  ///< in a link: the surface folds by 60 degrees or more there

  /// The segment beyond a side, -1: none.
  KOKKOS_INLINE_FUNCTION int beyond(int side) const { return link[side] < 0 ? -1 : link[side] & ~over_fold; }
  KOKKOS_INLINE_FUNCTION bool folds(int side) const { return link[side] >= 0 && (link[side] & over_fold) != 0; }
};

/// A corner at the mouth of a crack, slot or gap that is crossed: half of a node of this lip, half of the place of the
/// other lip that is nearest, between two nodes. Both lips meet there, so that the surface goes on from one to the
/// other without a step, what presses there presses on both, and no energy is lost over the mouth.
struct alignas(16) MouthCorner {
  static constexpr int pieces = 3;
  int node[pieces];      ///< of the model: of this lip, then two of the other
  double share[pieces];  ///< where the lips are together: one half; what the other two have of the other half
  double widest;         ///< m; from that to twice that between the lips, the corner goes back to its node
};

/// A box in single precision, m, a little larger than what it holds, so that rounding leaves nothing out.
struct alignas(16) RoundedBox {
  float low[3], high[3];
  float unused[2];
};

/// Boxes around the master's segments, by which those near a place are found: leaves of eight segments, branches of
/// sixteen leaves, boughs of sixteen branches, in an order in which neighbours are near each other. They hold until the
/// next check.
struct SegmentBoxes {
  static constexpr int leaf_size = 8, branch_size = 16, bough_size = 16;
  Array<int*> order;           ///< of the segments
  Array<RoundedBox*> segment;  ///< by place in the order
  Array<RoundedBox*> leaf;
  Array<RoundedBox*> branch;
  Array<RoundedBox*> bough;
  Array<double* [3]>
      normal;  ///< outward unit normals of the segments' middles at the last check; by place in the order

  KOKKOS_INLINE_FUNCTION int segment_count() const { return static_cast<int>(segment.extent(0)); }
  KOKKOS_INLINE_FUNCTION int leaf_count() const { return static_cast<int>(leaf.extent(0)); }
  KOKKOS_INLINE_FUNCTION int branch_count() const { return static_cast<int>(branch.extent(0)); }
  KOKKOS_INLINE_FUNCTION int bough_count() const { return static_cast<int>(bough.extent(0)); }
};

/// One contact pair: the slave's nodes against the master's segments (thesis 2.6). Master nodes have a numbering of
/// their own; `master_nodes` and `slave_nodes` lead to the model's.
struct ContactArrays {
  int slave_count = 0, master_count = 0, segment_count = 0;
  double friction = 0;
  Array<int*> slave_nodes;
  Array<int*> master_nodes;
  Array<int* [4]> segments;     ///< master node numbers, turned outwards
  Array<int*> first_segment;    ///< master_count + 1
  Array<int*> segment_of_node;  ///< segments around a master node
  Array<Segment*> surface;      ///< the same segments by model node numbers, with their neighbours
  Array<MouthCorner*> mouth_corners;
  SegmentBoxes boxes;
  Array<double*> segment_stiffness;  ///< N/m, eq. 2.26d

  /// A corner's node; at a mouth that of its own lip.
  KOKKOS_INLINE_FUNCTION int node_of(int corner) const {
    return corner >= 0 ? corner : mouth_corners(-1 - corner).node[0];
  }

  /// What the pair does now, by slave node.
  Array<int*> tracked;                  ///< segment that the node was last seen over, touched or not; -1: none yet
  Array<double* [2]> place;             ///< xi, eta on the tracked segment
  Array<int*> status;                   ///< 0: apart, 1: sticks, 2: slips
  Array<double*> gap;                   ///< m, negative: penetration; as old as the last check where the node is far;
                                        ///< beside_surface, turned_away
  Array<double*> entry_depth;           ///< m: how deep the node was when it came in beside an open surface; its gap
                                        ///< counts from there
  Array<double* [3]> normal_force;      ///< N on the slave
  Array<double* [3]> tangential_force;  ///< N on the slave
  Array<double*> friction_energy;       ///< J dissipated so far
};

/// A slave node in the window.
struct alignas(16) WindowEntry {
  int slave;  ///< position among the pair's slave nodes
  int node;   ///< model node number
  int near;   ///< near_one_sheet, near_several_sheets: it can touch until the next check, and is projected at each step
              ///< unless it rests; 0: far
  int rests;  ///< steps after the check until it is looked at again, as it surely touches no sooner; 0: it doesn't rest

  /// Whether each step projects it.
  KOKKOS_INLINE_FUNCTION bool projected() const { return near != 0 && rests == 0; }
};

/// The slave nodes that can touch before the window is built again, ascending, and those of them that each step
/// projects.
struct ContactWindow {
  int count = 0;
  int room = 0;                 ///< nodes that launches are made for at least
  Array<WindowEntry*> entries;  ///< room for all slave nodes, as `near`; the window's come first
  Array<int*> near;             ///< places in `entries`, in any order: what the nodes do does not depend on each other
  Array<int*> near_count;       ///< one

  /// What a GPU's launches over the near nodes, whose number the device knows, are made for: no less than the window
  /// has, and seldom another, so that they can be recorded.
  KOKKOS_INLINE_FUNCTION int bound() const { return ((count > room ? count : room) + grain - 1) / grain * grain; }

  /// How many nodes a launch over the near ones is for. A processor's threads share those that there are, where the
  /// first thread would have all of them if the others had the rest of the window.
  KOKKOS_INLINE_FUNCTION int launched() const {
    if constexpr (on_device)
      return bound();
    else
      return near_count(0);
  }

  /// The number of nodes from now on. Where it is more than there is room for, room for an eighth more is made, and
  /// kept: launches of another size are recorded anew, which takes as long as a hundred steps.
  void resize(int nodes) {
    count = nodes;
    if (nodes > room) room = nodes + nodes / 8;
  }
  static constexpr int grain = 256;
};

inline constexpr int status_apart = 0, status_sticks = 1, status_slips = 2;

/// What a node in the window can meet: one stretch of the surface, over which it is followed, or several that face
/// different ways, so that at each step the nearest is searched for.
inline constexpr int near_one_sheet = 1, near_several_sheets = 2;

/// Gaps of nodes that have none, m: beside the surface; in the body, but not come through the surface.
inline constexpr double beside_surface = 1e300, turned_away = 2e300;
/// Whether a gap is a distance.
KOKKOS_INLINE_FUNCTION bool is_distance(double gap) { return gap < 1e299; }

/// Bilinear shape functions of a segment, eq. 2.24b.
KOKKOS_INLINE_FUNCTION double segment_shape(int corner, double xi, double eta) {
  const double sign_xi = corner == 1 || corner == 2 ? 1.0 : -1.0;
  const double sign_eta = corner >= 2 ? 1.0 : -1.0;
  return 0.25 * (1.0 + sign_xi * xi) * (1.0 + sign_eta * eta);
}

/// What a pair keeps for its law.
struct ContactLawArrays {
  int number = 0;                       ///< of the law among `ContactLaws`, see src/model/contact/contact_law.hpp
  Array<PenaltyGrowth::Point*> growth;  ///< empty without
  Array<double*> state;                 ///< the law's state, value by value, each by slave node
};

}  // namespace railwave
