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

  /// Takes the segment around a node that the slave's projection is least outside of.
  KOKKOS_INLINE_FUNCTION void try_around(const Vector3& slave, int node, int tried, Projection& best, double& least) const {
    for (int s = contact.first_segment(node); s < contact.first_segment(node + 1) && least > on_segment; ++s) {
      if (contact.segment_of_node(s) == tried) continue;
      const Projection other = project(slave, contact.segment_of_node(s));
      if (outside(other) < least) {
        least = outside(other);
        best = other;
      }
    }
  }

  /// The segment that holds the slave's projection, or the one that it is least outside of; then clamped to its sides.
  /// @param previous segment touched at the last step, -1: none
  /// @param beyond how far outside the projection lies, before it was clamped
  KOKKOS_INLINE_FUNCTION Projection nearest(const Vector3& slave, int node, int previous, double& beyond) const {
    const int begin = contact.first_segment(node), end = contact.first_segment(node + 1);
    int chosen = -1;
    for (int s = begin; s < end && chosen < 0; ++s)
      if (contact.segment_of_node(s) == previous && between_edges(slave, node, previous)) chosen = previous;
    for (int s = begin; s < end && chosen < 0; ++s)
      if (between_edges(slave, node, contact.segment_of_node(s))) chosen = contact.segment_of_node(s);

    Projection best{};
    beyond = 1e300;
    if (chosen >= 0) {
      best = project(slave, chosen);
      beyond = outside(best);
    }
    // Folds, warped and slender segments: the test with plane edges and the true projection can disagree, and on a
    // disordered mesh the segment that holds the projection need not touch the closest node.
    if (beyond > on_segment) try_around(slave, node, chosen, best, beyond);
    for (int s = begin; s < end && beyond > on_segment; ++s)
      for (int k = 0; k < 4 && beyond > on_segment; ++k) {
        const int other = contact.segments(contact.segment_of_node(s), k);
        if (other != node) try_around(slave, other, chosen, best, beyond);
      }
    return beyond > 0 ? clamped(slave, best) : best;
  }

  /// The same, with segment -1 where the slave stands beside the surface.
  KOKKOS_INLINE_FUNCTION Projection locate(const Vector3& slave, int node, int previous) const {
    double beyond;
    Projection result = nearest(slave, node, previous, beyond);
    if (beyond > outside_tolerance) result.segment = -1;
    return result;
  }

  /// Master node of a segment's corner next to a place on it: where a walk begins.
  KOKKOS_INLINE_FUNCTION int corner_at(int segment, double xi, double eta) const {
    return contact.segments(segment, eta < 0 ? (xi < 0 ? 0 : 1) : (xi < 0 ? 3 : 2));
  }
};

}  // namespace railwave
