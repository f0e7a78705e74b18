#pragma once

#include "kernels/contact/contact_boxes.hpp"
#include "kernels/contact/contact_projection.hpp"

namespace railwave {

/// Search for the segment that a slave node meets: the one whose nearest place is nearest, whatever segments share its
/// nodes (thesis 2.6.1 starts from the closest master node instead, which a crack, a fold or a slender segment can
/// deceive). Of several equally near, as at a common side, the one whose projection is least outside, then the first.
/// The result does not depend on where the search begins.
struct ContactSearch : ContactProjection {
  /// How deep a projection outside a segment may be, of the segment's diagonal: no sound contact is.
  static constexpr double outside_depth = 0.25;
  /// Of a segment's size: places no farther apart than that are one, found on several segments.
  static constexpr double rounding = 1e-12;
  /// Of unit normals' mean: below, the surface folds by 60 degrees or more.
  static constexpr double smooth_mean = 0.866;

  /// @param start a segment from which the search may begin, best one that is near
  /// @param beyond how far outside the segment the projection lay, before it was clamped to its sides; where the
  /// surface goes on, nothing is outside
  /// @param surely the nearest segment is known to be `start`, and its nearest place inside its sides
  KOKKOS_INLINE_FUNCTION Projection nearest(const Vector3& slave, int start, double& beyond,
                                            bool surely = false) const {
    int best = start;
    NearestPlace place = nearest_within(see(slave, start));
    // Mostly it is that one, and then hardly a box is opened.
    double limit = place.squared;
    if (!surely) place = NearestPlace::none();
    Meeting meeting;
    // First what is nearest. If that is at a side, then once more, for what has the same place. One loop, so that one
    // copy does.
    for (int turn = surely ? 2 : 0; turn < 2; ++turn) {
      visit_boxes(contact.boxes, slave, limit, [&](int i) {
        const SeenSegment seen = see(slave, contact.boxes.order(i));
        NearestPlace found;
        if (!within(seen, limit, found)) return true;
        if (turn == 1) {
          if (meeting.has(seen, found)) meeting.take(seen.segment, found, meeting_normal(seen, found));
        } else if (nearer(found, seen.segment, place, best)) {
          best = seen.segment;
          place = found;
          limit = found.squared;
        }
        return true;
      });
      if (turn == 1 || !at_side(place.place)) break;
      meeting.begin(see(slave, best), place);
      limit = meeting.limit(place);
    }
    return concluded(slave, best, place, meeting, beyond);
  }

  /// The same where it is known that no other segments than two that share a side are as near.
  KOKKOS_INLINE_FUNCTION Projection nearest_of_two(const Vector3& slave, int one, int other, double& beyond) const {
    int best = one;
    NearestPlace place = NearestPlace::none(), found[2];
    for (int k = 0; k < 2; ++k) {
      const int segment = k == 0 ? one : other;
      found[k] = nearest_within(see(slave, segment));
      if (!nearer(found[k], segment, place, best)) continue;
      best = segment;
      place = found[k];
    }
    Meeting meeting;
    if (at_side(place.place)) {
      meeting.begin(see(slave, best), place);
      for (int k = 0; k < 2; ++k) {
        const SeenSegment seen = see(slave, k == 0 ? one : other);
        if (found[k].squared <= meeting.limit(place) && meeting.has(seen, found[k]))
          meeting.take(seen.segment, found[k], meeting_normal(seen, found[k]));
      }
    }
    return concluded(slave, best, place, meeting, beyond);
  }

  /// Whether any segment's box is within a distance, m.
  KOKKOS_INLINE_FUNCTION bool comes_within(const Vector3& slave, double distance) const {
    bool found = false;
    visit_boxes(contact.boxes, slave, distance * distance, [&](int) {
      found = true;
      return false;
    });
    return found;
  }

  /// Where a slave is, with segment -1 where it stands beside the surface.
  KOKKOS_INLINE_FUNCTION Projection locate(const Vector3& slave, int start) const {
    double beyond;
    const Projection found = nearest(slave, start, beyond);
    return unless_beside(found, beyond);
  }

  KOKKOS_INLINE_FUNCTION Projection unless_beside(Projection found, double beyond) const {
    if (beside(found, beyond)) found.segment = -1;
    return found;
  }

  /// Whether a projection that lay `beyond` its segment does not belong to the surface: too far outside, or outside and
  /// as deep as what moves beside a body.
  KOKKOS_INLINE_FUNCTION bool beside(const Projection& found, double beyond) const {
    if (beyond <= on_segment) return false;
    if (beyond > outside_tolerance) return true;
    return found.gap < -outside_depth * norm(diagonal(contact.surface(found.segment)));
  }

  /// Whether segments that turn from the nearest by 60 degrees or more can be met within a distance from the slave.
  /// Right at a check.
  KOKKOS_INLINE_FUNCTION bool several_sheets(const Vector3& slave, const Projection& nearest, double distance) const {
    bool found = false;
    const Vector3 normal = normal_at(slave, nearest);
    visit_boxes(contact.boxes, slave, distance * distance, [&](int i) {
      found = turned_from(normal, i);
      return !found;
    });
    return found;
  }

  // What the search consists of, for those who take its steps side by side (team_search.hpp).

  KOKKOS_INLINE_FUNCTION Vector3 normal_at(const Vector3& slave, const Projection& nearest) const {
    return unit_normal(see(slave, nearest.segment), nearest.place);
  }

  /// Whether a segment, by its place in the order, turns from a normal by 60 degrees or more.
  KOKKOS_INLINE_FUNCTION bool turned_from(const Vector3& normal, int box) const {
    return dot(row(contact.boxes.normal, box), normal) < 0.5;
  }

  /// Whether a segment has a place within a distance, m2. Boxes are as large as the way until the next check, and hold
  /// slaves of many segments around; to rule a segment out by its corners is far less work than a projection.
  /// @param found its nearest place, if it has one
  KOKKOS_INLINE_FUNCTION static bool within(const SeenSegment& seen, double squared, NearestPlace& found) {
    if (surely_beyond(seen, squared)) return false;
    found = nearest_within(seen);
    return !(found.squared > squared);
  }

  KOKKOS_INLINE_FUNCTION static bool nearer(const NearestPlace& found, int segment, const NearestPlace& best,
                                            int best_segment) {
    return found.squared < best.squared || (found.squared == best.squared && segment < best_segment);
  }

  KOKKOS_INLINE_FUNCTION static bool at_side(const SegmentPlace& p) { return p.outside() > -1e-9; }

  /// A segment's normal at its nearest place, and its weight.
  struct MeetingNormal {
    Vector3 normal;
    double angle;
  };
  KOKKOS_INLINE_FUNCTION static MeetingNormal meeting_normal(const SeenSegment& seen, const NearestPlace& found) {
    return {unit_normal(seen, found.place), corner_angle(seen, found.place)};
  }

  /// The segments that have the nearest place in common, as at a side or a corner.
  struct Meeting {
    Vector3 there{{0, 0, 0}};                     ///< m, the place, less the slave's position
    double same_place = 0;                        ///< m
    Vector3 sum{{0, 0, 0}}, weighted{{0, 0, 0}};  ///< of their normals there
    int count = 0, segment = -1;                  ///< of which the projection is least outside, then the first
    NearestPlace place = NearestPlace::none();    ///< of that one

    KOKKOS_INLINE_FUNCTION void begin(const SeenSegment& nearest, const NearestPlace& at) {
      there = nearest.point(at.place);
      same_place = rounding * (norm(nearest.across) + norm(nearest.along));
    }

    /// m2, within which they all have their nearest places.
    KOKKOS_INLINE_FUNCTION double limit(const NearestPlace& nearest) const {
      const double distance = std::sqrt(nearest.squared) + same_place;
      return distance * distance;
    }

    KOKKOS_INLINE_FUNCTION bool has(const SeenSegment& seen, const NearestPlace& found) const {
      const Vector3 aside = seen.point(found.place) - there;
      return !(dot(aside, aside) > same_place * same_place);
    }

    /// Always in the order of their boxes, so that sums are the same.
    KOKKOS_INLINE_FUNCTION void take(int of, const NearestPlace& found, const MeetingNormal& with) {
      sum = sum + with.normal;
      weighted = weighted + with.angle * with.normal;
      const double now = std::fmax(0.0, found.outside), before = std::fmax(0.0, place.outside);
      if (count++ > 0 && !(now < before || (now == before && of < segment))) return;
      segment = of;
      place = found;
    }
  };

  /// @param best, place the nearest; @param meeting of a place that is not at a side: nobody
  KOKKOS_INLINE_FUNCTION Projection concluded(const Vector3& slave, int best, NearestPlace place,
                                              const Meeting& meeting, double& beyond) const {
    if (meeting.count > 0) {
      best = meeting.segment;
      place = meeting.place;
    }
    beyond = place.outside;
    const SeenSegment seen = see(slave, best);
    Projection result = at(seen, place.place);
    if (meeting.count > 1 && place.outside > 0 && goes_on(contact.surface(best), nearest_place(seen, {0, 0}))) {
      towards_side(result, meeting.weighted);
      result.at_edge = norm(meeting.sum) < smooth_mean * meeting.count;
      beyond = 0;
    }
    return result;
  }

 private:
  /// Whether no place of a segment is within a distance, m2, of the slave, whatever rounding does.
  KOKKOS_INLINE_FUNCTION static bool surely_beyond(const SeenSegment& seen, double squared) {
    const double size = dot(seen.across, seen.across) + dot(seen.along, seen.along);
    return seen.least_squared_distance() > (1 + 1e-6) * squared + rounding * rounding * size;
  }

  /// Whether the surface goes on beyond each of the sides that a place lies beyond.
  KOKKOS_INLINE_FUNCTION static bool goes_on(const Segment& segment, const SegmentPlace& p) {
    const double beyond[4] = {-p.eta - 1, p.xi - 1, p.eta - 1, -p.xi - 1};
    for (int side = 0; side < 4; ++side)
      if (beyond[side] > on_segment && segment.link[side] < 0) return false;
    return true;
  }

  KOKKOS_INLINE_FUNCTION static Vector3 unit_normal(const SeenSegment& seen, const SegmentPlace& p) {
    const Vector3 n = cross(seen.slope_xi(p.eta), seen.slope_eta(p.xi));
    return (1 / norm(n)) * n;
  }

  /// A segment's angle at a place: pi inside a side, that of the corner at a corner.
  KOKKOS_INLINE_FUNCTION static double corner_angle(const SeenSegment& seen, const SegmentPlace& p) {
    constexpr double half_turn = 3.14159265358979323846;
    if (std::fmin(std::fabs(p.xi), std::fabs(p.eta)) < 1 - 1e-9) return half_turn;
    const Vector3 a = seen.slope_xi(p.eta), b = seen.slope_eta(p.xi);
    const double cosine = dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
    return std::acos(std::fmax(-1.0, std::fmin(1.0, p.xi * p.eta > 0 ? cosine : -cosine)));
  }

  /// Over a side or corner where the slave's projection lies inside no segment, the way between it and the slave is the
  /// normal: so it turns from that of one segment to that of the next. Which side of the surface the slave is on is
  /// decided by the mean of the normals around, weighted by angles (Baerentzen and Aanaes 2005).
  KOKKOS_INLINE_FUNCTION static void towards_side(Projection& result, const Vector3& weighted) {
    const double distance = norm(result.offset);
    if (!(distance > 1e-12)) return;
    const bool inside = dot(result.offset, weighted) > 0;
    result.normal = ((inside ? 1 : -1) / distance) * result.offset;
    result.gap = inside ? -distance : distance;
  }
};

}  // namespace railwave
