#pragma once

#include "kernels/contact_projection.hpp"

namespace railwave {

/// Search of thesis 2.6.1 that knows nothing of the steps before but where to begin: closest master node, the segment around
/// it that holds the slave's projection (eq. 2.23), the contact point by Newton iteration (eq. 2.25), the penetration
/// (eq. 2.26a). Its result does not depend on where it begins.
struct ContactSearch : ContactProjection {
  /// A projection may lie this far outside a segment, in xi or eta, and still belong to the surface: on a convex fold
  /// a penetrating node can be outside both neighbours.
  static constexpr double outside_tolerance = 0.05;
  /// How deep it may then be, of the segment's diagonal: no sound contact is.
  static constexpr double outside_depth = 0.25;
  static constexpr int most_hops = 8;

  KOKKOS_INLINE_FUNCTION Vector3 master(int m) const { return row(position, contact.master_nodes(m)); }

  /// Walks over the mesh from a master node to the nearest one around; of nodes equally near to the first.
  KOKKOS_INLINE_FUNCTION int closest_node(const Vector3& slave, int start) const {
    int best = start;
    Vector3 d = slave - master(best);
    double least = dot(d, d);
    for (int hop = 0; hop < 64; ++hop) {
      const int here = best;
      for (int s = contact.first_segment(here); s < contact.first_segment(here + 1); ++s)
        for (int k = 0; k < 4; ++k) {
          const int m = contact.segments(contact.segment_of_node(s), k);
          d = slave - master(m);
          const double distance = dot(d, d);
          if (distance < least || (distance == least && m < best)) {
            least = distance;
            best = m;
          }
        }
      if (best == here) break;
    }
    return best;
  }

  /// Eq. 2.23: is the slave's projection between the two edges of the segment that start at the closest node?
  KOKKOS_INLINE_FUNCTION bool between_edges(const Vector3& slave, int node, int segment) const {
    int k = 0;
    while (k < 3 && contact.segments(segment, k) != node) ++k;
    const Vector3 origin = master(node);
    const Vector3 c1 = master(contact.segments(segment, (k + 1) % 4)) - origin;
    const Vector3 c2 = master(contact.segments(segment, (k + 3) % 4)) - origin;
    const Vector3 g = slave - origin;
    const Vector3 m = cross(c1, c2);
    const Vector3 s = g - (dot(g, m) / dot(m, m)) * m;
    const Vector3 c1s = cross(c1, s);
    return dot(c1s, m) >= 0 && dot(c1s, cross(s, c2)) >= 0;
  }

  /// The segment that holds the slave's projection, or the one that it is least outside of; then clamped to its sides.
  /// @param previous segment touched at the last step, -1: none
  /// @param beyond how far outside the projection lay, before it was clamped
  KOKKOS_INLINE_FUNCTION Projection nearest(const Vector3& slave, int node, int previous, double& beyond) const {
    const int begin = contact.first_segment(node), end = contact.first_segment(node + 1);
    int chosen = -1;
    // Behind a sharp edge the nearest of those that hold it counts: another may be as deep as a whole segment is long.
    const bool all = contact.folded_outwards;
    double least = 1e300;
    for (int s = begin; s < end && chosen < 0 && !all; ++s)
      if (contact.segment_of_node(s) == previous && between_edges(slave, node, previous)) chosen = s;
    for (int s = begin; s < end && chosen < 0 && !all; ++s)
      if (between_edges(slave, node, contact.segment_of_node(s))) chosen = s;

    SeenSegment best{};
    SegmentPlace place{};
    beyond = 1e300;
    // First the chosen segment. Folds, warped and slender segments: the test with plane edges and the true projection can
    // disagree, and on a disordered mesh the segment that holds the projection need not touch the closest node; so then
    // those around that node, and those around their corners. One loop, so that one copy of the projection does.
    // At last over the sides from what is least outside: slender segments can be farther from the closest node than that.
    const int hops = 4 * (end - begin);
    for (int turn = chosen < 0 ? -1 : -2; turn < hops + most_hops && beyond > on_segment; ++turn) {
      int first = chosen, last = chosen + 1, next = -1;
      if (turn >= hops) {
        next = beyond_side(contact.surface(best.segment), place);
        if (next < 0) break;
        first = 0;
        last = 1;
      } else if (turn > -2) {
        const int around = turn < 0 ? node : contact.segments(contact.segment_of_node(begin + turn / 4), turn % 4);
        if (turn >= 0 && around == node) continue;
        first = contact.first_segment(around);
        last = contact.first_segment(around + 1);
      }
      for (int s = first; s < last && (all || beyond > on_segment); ++s) {
        const int segment = next >= 0 ? next : contact.segment_of_node(s);
        if (turn > -2 && chosen >= 0 && segment == contact.segment_of_node(chosen)) continue;
        const SeenSegment seen = see(slave, segment);
        const SegmentPlace found = nearest_place(seen, {0, 0});
        bool better = found.outside() < beyond;
        if (all && found.outside() <= on_segment) {
          const Vector3 offset = seen.point(found);
          better = beyond > on_segment || dot(offset, offset) < least;
          if (better) least = dot(offset, offset);
        } else if (all && beyond <= on_segment) {
          better = false;
        }
        if (better) {
          beyond = found.outside();
          best = seen;
          place = found;
        }
      }
      if (next >= 0 && best.segment != next) break;
    }
    return at(best, place.clamped());
  }

  /// The same, with segment -1 where the slave stands beside the surface.
  KOKKOS_INLINE_FUNCTION Projection locate(const Vector3& slave, int node, int previous) const {
    double beyond;
    Projection result = nearest(slave, node, previous, beyond);
    if (beside(result, beyond)) result.segment = -1;
    return result;
  }

  /// Whether a projection that lay `beyond` its segment does not belong to the surface: too far outside, or outside and
  /// as deep as what moves beside a body.
  KOKKOS_INLINE_FUNCTION bool beside(const Projection& found, double beyond) const {
    if (beyond <= on_segment) return false;
    if (beyond > outside_tolerance) return true;
    const Segment segment = contact.surface(found.segment);
    const Vector3 diagonal = row(position, segment.node[2]) - row(position, segment.node[0]);
    return found.gap < -outside_depth * norm(diagonal);
  }

  /// Master node of a segment's corner next to a place on it: where a walk begins.
  KOKKOS_INLINE_FUNCTION int corner_at(int segment, const SegmentPlace& p) const {
    return contact.segments(segment, p.eta < 0 ? (p.xi < 0 ? 0 : 1) : (p.xi < 0 ? 3 : 2));
  }
};

}  // namespace railwave
