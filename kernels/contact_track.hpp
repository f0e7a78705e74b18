#pragma once

#include "kernels/contact_search.hpp"

namespace railwave {

/// The fast way to a slave node's segment: from where it was over the surface a step ago, over the sides of segments where
/// it has left one. Right in all but rare cases, and it knows those.
struct ContactTrack {
  enum Verdict {
    over_segment,  ///< the projection lies inside a segment
    over_fold,     ///< in the wedge along the side of two segments where it lies inside neither
    surely_apart,  ///< beyond the surface's end or over a convex corner, and outside all segments there
    unknown        ///< always where the master is folded inwards: there more than one segment can hold a projection
  };

  /// @param now in: a place on a segment; out: the projection, clamped to the sides of its segment
  /// @param beyond how far outside it lay, before it was clamped
  KOKKOS_INLINE_FUNCTION static Verdict follow(const ContactProjection& search, const Vector3& slave, Projection& now,
                                               double& beyond) {
    beyond = 1e300;
    if (search.contact.folded_inwards) return unknown;
    int segment = now.segment, from = -1;
    SegmentPlace place = now.place;
    bool apart = true, arrived = false, came_over_side = false;
    for (int hop = 0; hop < 4 && !arrived; ++hop) {
      const SeenSegment seen = search.see(slave, segment);
      place = ContactProjection::nearest_place(seen, place);
      const double outside = place.outside();
      const Projection here = ContactProjection::at(seen, place.clamped());
      if (outside < beyond) {
        beyond = outside;
        now = here;
      }
      if (outside <= ContactProjection::on_segment) return over_segment;
      apart = apart && here.gap > 0;
      const int next = ContactProjection::beyond_side(search.contact.surface(segment), place);
      const bool over_side = std::fmin(std::fabs(place.xi), std::fabs(place.eta)) <= 1.0;
      if (next >= 0 && next == from && over_side && came_over_side) return over_fold;
      arrived = next < 0 || next == from;
      came_over_side = over_side;
      from = segment;
      segment = next;
      place = {0, 0};
    }
    return apart && arrived ? surely_apart : unknown;
  }

  /// Where a slave stands now; gap 1e300 where beside the surface. What ends being apart is searched anew, so that it
  /// does not depend on the way there; a contact keeps its segment as long as that holds the projection.
  /// @param tracked, place where it was over the surface a step ago
  /// @param touched whether it was in contact then
  KOKKOS_INLINE_FUNCTION static Projection where(const ContactSearch& search, const Vector3& slave, int tracked,
                                                 const SegmentPlace& place, bool touched) {
    Projection now{};
    now.segment = tracked;
    now.place = place;
    double beyond;
    const auto verdict = follow(search, slave, now, beyond);
    const bool over = verdict == over_segment;
    const bool begins = !touched && now.gap < 0 && beyond <= ContactSearch::outside_tolerance;
    if (verdict == unknown || begins) {
      double found_beyond;
      const int start = search.corner_at(now.segment, now.place);
      const Projection found = search.nearest(slave, search.closest_node(slave, start), touched ? tracked : -1, found_beyond);
      if (!over || found_beyond <= ContactSearch::outside_tolerance) {
        now = found;
        beyond = found_beyond;
      }
    }
    if (search.beside(now, beyond)) now.gap = 1e300;
    return now;
  }
};

}  // namespace railwave
