#pragma once

#include "kernels/contact/contact_normals.hpp"

namespace railwave {

/// The fast way to a slave node's segment: from where it was over the surface a step ago, over the sides of segments
/// where it has left one. Right in all but rare cases, and it knows those.
struct ContactTrack {
  enum Verdict {
    over_segment,  ///< the projection lies inside a segment
    over_fold,     ///< outside, in the wedge along the side of two segments where it lies inside neither
    under_fold,    ///< the same inside the body
    surely_apart,  ///< beyond the surface's end or over a convex corner, and outside all segments there
    unknown        ///< always where the way leads over a sharp fold
  };

  /// @param now in: a place on a segment; out: the projection, clamped to the sides of its segment
  /// @param beyond how far outside it lay, before it was clamped
  /// @param other out, at a fold: the other of the two segments
  KOKKOS_INLINE_FUNCTION static Verdict follow(const ContactProjection& search, const Vector3& slave, Projection& now,
                                               double& beyond, int& other) {
    beyond = 1e300;
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
      const Segment around = search.contact.surface(segment);
      const int side = ContactProjection::side_towards(place), next = around.beyond(side);
      if (around.folds(side)) return unknown;
      const bool over_side = std::fmin(std::fabs(place.xi), std::fabs(place.eta)) <= 1.0;
      if (next >= 0 && next == from && over_side && came_over_side) {
        other = now.segment == segment ? from : segment;
        return now.gap < 0 ? under_fold : over_fold;
      }
      arrived = next < 0 || next == from;
      came_over_side = over_side;
      from = segment;
      segment = next;
      place = {0, 0};
    }
    return apart && arrived ? surely_apart : unknown;
  }

  /// Where a slave stands now; no distance for a gap where beside the surface. What ends being apart is searched anew,
  /// so that it does not depend on the way there; a contact keeps its segment as long as that holds the projection.
  /// @param tracked, place where it was over the surface a step ago
  /// @param touched whether it was in contact then
  /// @param near of its entry in the window
  KOKKOS_INLINE_FUNCTION static Projection where(const ContactSearch& search, const Vector3& slave, int tracked,
                                                 const SegmentPlace& place, bool touched, int near) {
    Projection now{};
    now.segment = tracked;
    now.place = place;
    double beyond = 1e300;
    int other = -1;
    Verdict verdict = unknown;
    if (touched || near != near_several_sheets) verdict = follow(search, slave, now, beyond, other);
    const bool begins = !touched && now.gap < 0 && beyond <= ContactSearch::outside_tolerance;
    if (verdict == under_fold && surely_at_side(search, slave, now, other))
      now = search.nearest_of_two(slave, now.segment, other, beyond);
    else if (verdict == unknown || verdict == under_fold || begins)
      now = search.nearest(slave, now.segment, beyond,
                           begins && verdict == over_segment && surely_nearest(search, slave, now));
    if (search.beside(now, beyond)) now.gap = beside_surface;
    return now;
  }

  /// Whether a place is so far inside its segment that a search would find the same one. Around a slave that is
  /// followed the surface turns by less than 60 degrees, so that other segments are no nearer to the place than half of
  /// its way to the sides. Where one side alone is too near for that, the segment beyond it is looked at, and those
  /// behind it are no nearer than half of its width.
  KOKKOS_INLINE_FUNCTION static bool surely_nearest(const ContactSearch& search, const Vector3& slave,
                                                    const Projection& now) {
    const double squared = now.gap * now.gap, deep = reserve * reserve * squared;
    const SeenSegment seen = search.see(slave, now.segment);
    const Vector3 along_xi = seen.slope_xi(now.place.eta), along_eta = seen.slope_eta(now.place.xi);
    const double area = squared_area(along_xi, along_eta), to_xi = 1 - std::fabs(now.place.xi),
                 to_eta = 1 - std::fabs(now.place.eta);
    const bool inside_xi = to_xi * to_xi * area > deep * dot(along_eta, along_eta),
               inside_eta = to_eta * to_eta * area > deep * dot(along_xi, along_xi);
    if (inside_xi && inside_eta) return true;
    if ((!inside_xi && !inside_eta) || ContactSearch::at_side(now.place)) return false;
    const bool towards_xi = inside_eta, positive = (towards_xi ? now.place.xi : now.place.eta) > 0;
    const int side = towards_xi ? (positive ? 1 : 3) : (positive ? 2 : 0);
    const Segment around = search.contact.surface(now.segment);
    if (around.beyond(side) < 0 || around.folds(side)) return false;
    const SeenSegment next = search.see(slave, around.beyond(side));
    return is_wide(next, deep) && lies_beyond(next, positive ? 1.0 : -1.0, towards_xi ? along_xi : along_eta,
                                              towards_xi ? along_eta : along_xi, squared);
  }

  /// Whether no other segments are as near as the two on whose common side a place lies: those at its ends are too far
  /// away, and those behind the two no nearer than half of these' widths.
  KOKKOS_INLINE_FUNCTION static bool surely_at_side(const ContactProjection& search, const Vector3& slave,
                                                    const Projection& now, int other) {
    const double deep = reserve * reserve * dot(now.offset, now.offset);
    const SeenSegment seen = search.see(slave, now.segment);
    const bool of_xi = std::fabs(now.place.xi) >= 1;
    const Vector3 side = of_xi ? seen.slope_eta(now.place.xi) : seen.slope_xi(now.place.eta);
    const double to_end = 1 - std::fabs(of_xi ? now.place.eta : now.place.xi);
    return to_end > 0 && to_end * to_end * dot(side, side) > deep && is_wide(seen, deep) &&
           is_wide(search.see(slave, other), deep);
  }

 private:
  static constexpr double reserve = 16;  ///< half of the way, twice the depth, and as much again for distorted segments

  /// Whether a segment is wider than the root of that, m2.
  KOKKOS_INLINE_FUNCTION static bool is_wide(const SeenSegment& seen, double squared) {
    return squared_area(seen.across, seen.along) >
           squared * std::fmax(dot(seen.across, seen.across), dot(seen.along, seen.along));
  }

  KOKKOS_INLINE_FUNCTION static double squared_area(const Vector3& a, const Vector3& b) {
    const Vector3 area = cross(a, b);
    return dot(area, area);
  }

  /// Whether all of a segment is farther from the slave than a distance, m2, in the direction of `sign` times what
  /// `across` has at a right angle to `side`.
  KOKKOS_INLINE_FUNCTION static bool lies_beyond(const SeenSegment& segment, double sign, const Vector3& across,
                                                 const Vector3& side, double squared) {
    const Vector3 out = sign * (across - (dot(across, side) / dot(side, side)) * side);
    double least = 1e300;
    for (int k = 0; k < 4; ++k) least = std::fmin(least, dot(segment.corner(k), out));
    constexpr double rounding = 1.0001;
    return least > 0 && least * least > rounding * squared * dot(out, out);
  }
};

/// Which nodes that are found in the body have come in through its surface: those no deeper than both have moved since
/// the node was last seen apart; and around a sharp edge, or where the surface was not below before, only through a
/// face that the node was outside of. What comes in deep from beside an open surface, or was in the body when it came
/// to be checked, is turned away until it has left.
struct FirstTouch {
  LastStep last;      ///< no time elapsed: all is taken in
  double most_steps;  ///< how many steps the slowest node's own step takes (subcycling)

  static constexpr double reserve = 1.25;         ///< on the motion
  static constexpr double rounding_share = 1e-5;  ///< of a segment's diagonal
  /// So deep, of a segment's diagonal, a node may come in beside an open surface and touch: one body's surface rises
  /// beside what presses it down, and a node that goes from one contact's surface to the next one's has been pressed
  /// in. Its gap counts from there, so that no spring is pressed in that nobody has pressed.
  static constexpr double shallow_share = 0.05;

  /// @param tracked segment that the node was over when it was last seen apart
  KOKKOS_INLINE_FUNCTION void judge(const ContactSearch& search, int s, int node, int tracked, Projection& now) const {
    if (!(now.gap < 0) || !(last.elapsed > 0)) return;
    const double before = search.contact.gap(s);
    if (search.contact.entry_depth(s) > 0) return;
    if (before < 0) return;  // the check has seen it through, or it pressed a moment ago
    const Segment segment = search.contact.surface(now.segment);
    const Vector3 way = most_steps * last.relative_motion(search, node, now.segment, now.place);
    const double size = norm(search.diagonal(segment)), rounding = rounding_share * size,
                 deepest = reserve * norm(way) + rounding;
    const Vector3 slave = row(search.position, node);
    const bool strictly = !is_distance(before) || dot(middle_normal(search, slave, tracked), now.normal) < 0.5;
    if (-now.gap <= deepest && (!strictly || came_through(now, way, rounding))) return;
    const double depth = -now.gap;
    now.gap = turned_away;
    // Near an edge the nearest face need not be the one that the node came through.
    Projection through = now;
    for (int k = 0; k < 4; ++k) {
      const int corner = search.contact.segments(now.segment, k);
      for (int i = search.contact.first_segment(corner); i < search.contact.first_segment(corner + 1); ++i) {
        const SeenSegment seen = search.see(slave, search.contact.segment_of_node(i));
        const SegmentPlace place = ContactProjection::nearest_place(seen, {0, 0});
        if (place.outside() > ContactProjection::on_segment) continue;
        const Projection found = ContactProjection::at(seen, place);
        if (found.gap < 0 && -found.gap <= deepest && came_through(found, way, rounding) &&
            (!is_distance(through.gap) || found.gap > through.gap))
          through = found;
      }
    }
    if (is_distance(through.gap)) {
      now = through;
    } else if (before == beside_surface && depth <= shallow_share * size) {
      search.contact.entry_depth(s) = depth;
      now.gap = -depth;
    }
  }

  /// A gap from where the node came in.
  KOKKOS_INLINE_FUNCTION static void count_from_entry(const ContactArrays& contact, int s, Projection& now) {
    const double depth = contact.entry_depth(s);
    if (!(depth > 0)) return;
    if (now.gap < 0)
      now.gap += depth;
    else
      contact.entry_depth(s) = 0;
  }

 private:
  /// Whether the node was outside of the face before both moved.
  KOKKOS_INLINE_FUNCTION static bool came_through(const Projection& now, const Vector3& way, double rounding) {
    return now.gap - dot(now.normal, way) >= -rounding;
  }

  KOKKOS_INLINE_FUNCTION static Vector3 middle_normal(const ContactSearch& search, const Vector3& slave, int segment) {
    return ContactProjection::at(search.see(slave, segment), {0, 0}).normal;
  }
};

}  // namespace railwave
