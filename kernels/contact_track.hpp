#pragma once

#include "kernels/contact_projection.hpp"

namespace railwave {

/// The fast way to a slave node's segment: from where it was over the surface a step ago, over the sides of segments where
/// it has left one. Right in all but rare cases, and it knows those.
struct ContactTrack {
  enum Verdict {
    over_segment,  ///< the projection lies inside a segment
    surely_apart,  ///< over a convex fold or beyond the surface's end, and outside all segments there
    unknown
  };

  /// @param now in: a place on a segment; out: the projection, clamped to the sides of its segment unless it lies inside
  /// @param beyond how far outside it lies, before it was clamped
  KOKKOS_INLINE_FUNCTION static Verdict follow(const ContactProjection& search, const Vector3& slave, Projection& now,
                                               double& beyond) {
    int segment = now.segment, from = -1;
    double xi = now.xi, eta = now.eta;
    bool apart = true;
    beyond = 1e300;
    for (int hop = 0; hop < 4; ++hop) {
      const Projection here = search.project(slave, segment, xi, eta);
      if (outside(here) <= ContactProjection::on_segment) {
        now = here;
        beyond = 0;
        return over_segment;
      }
      const Projection edge = search.clamped(slave, here);
      apart = apart && edge.gap > 0;
      if (outside(here) < beyond) {
        beyond = outside(here);
        now = edge;
      }
      const int next = beyond_side(search.contact.surface(segment), here);
      if (next < 0 || next == from) break;
      from = segment;
      segment = next;
      xi = eta = 0;
    }
    return apart ? surely_apart : unknown;
  }

  /// The neighbour over the side that a projection lies farthest beyond.
  KOKKOS_INLINE_FUNCTION static int beyond_side(const Segment& segment, const Projection& p) {
    const bool along_xi = std::fabs(p.xi) >= std::fabs(p.eta);
    return along_xi ? segment.neighbour[p.xi > 0 ? 1 : 3] : segment.neighbour[p.eta > 0 ? 2 : 0];
  }
};

}  // namespace railwave
