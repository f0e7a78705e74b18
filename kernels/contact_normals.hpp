#pragma once

#include "kernels/contact_search.hpp"

namespace railwave {

/// A contact pushes along the normal of the facet that it is on, which jumps from facet to facet.
struct FacetNormals {
  KOKKOS_INLINE_FUNCTION static Projection turned(const ContactSearch& /*search*/, const Vector3& /*slave*/, const Projection& found) {
    return found;
  }
};

/// A vector that is bilinear over a segment.
struct OverSegment {
  Vector3 middle, across, along, twist;

  KOKKOS_INLINE_FUNCTION explicit OverSegment(const Vector3 (&corner)[4])
      : middle(0.25 * (corner[0] + corner[1] + corner[2] + corner[3])),
        across(0.25 * (corner[1] - corner[0] + corner[2] - corner[3])),
        along(0.25 * (corner[3] - corner[0] + corner[2] - corner[1])),
        twist(0.25 * (corner[0] - corner[1] + corner[2] - corner[3])) {}
  KOKKOS_INLINE_FUNCTION Vector3 at(const SegmentPlace& p) const { return middle + p.xi * (across + p.eta * twist) + p.eta * along; }
};

/// A contact pushes along a normal that is continuous over the master: at its nodes the mean of the facets around, weighted by
/// their areas, and bilinear between. The contact point is where that normal leads to the slave, so forces on both sides lie in
/// one line. The gap is that of the curved surface which has these normals: of a node that slides over plane facets the
/// direction alone would be smooth, but not its way. Facets that meet at more than 30 degrees make an edge: each has its own
/// normal there.
struct SmoothNormals {
  static constexpr double same_surface = 0.866;  ///< cosine of that angle
  static constexpr double near_share = 0.1;      ///< of the segment's diagonal: nodes farther off cannot touch
  static constexpr int most_hops = 3;

  KOKKOS_INLINE_FUNCTION static Projection turned(const ContactSearch& search, const Vector3& slave, Projection found) {
    if (!is_distance(found.gap) || found.at_edge) return found;
    SeenSegment seen = search.see(slave, found.segment);
    if (found.gap > near_share * 2 * norm(seen.across + seen.along)) return found;
    int from = -1;
    for (int hop = 0; hop < most_hops; ++hop) {
      Vector3 corner[4];
      const Vector3 facet = area_of(search, found.segment);
      for (int k = 0; k < 4; ++k) corner[k] = normal_at(search, found.segment, k, facet);
      const OverSegment normal(corner);
      const SegmentPlace place = reached(seen, normal, found.place);
      found.place = place.clamped();
      const Vector3 n = normal.at(found.place);
      found.normal = (1 / norm(n)) * n;
      found.offset = seen.point(found.place);
      found.gap = -dot(found.normal, found.offset) - bulge(seen, corner, found.place);
      if (place.outside() <= ContactProjection::on_segment) break;
      const int next = search.contact.surface(found.segment).beyond(ContactProjection::side_towards(place));
      if (next < 0 || next == from || hop + 1 == most_hops || !continues(facet, area_of(search, next))) break;
      from = found.segment;
      found.segment = next;
      seen = search.see(slave, next);
      found.place = ContactProjection::nearest_place(seen, {0, 0}).clamped();
    }
    return found;
  }

  KOKKOS_INLINE_FUNCTION static bool continues(const Vector3& facet, const Vector3& other) {
    return dot(facet, other) > same_surface * norm(facet) * norm(other);
  }

  /// Outwards, as long as the segment's area twice.
  KOKKOS_INLINE_FUNCTION static Vector3 area_of(const ContactSearch& search, int segment) {
    const Segment s = search.contact.surface(segment);
    return cross(search.diagonal(s), search.at_corner(search.position, s.node[3]) - search.at_corner(search.position, s.node[1]));
  }

  /// Unit normal at a segment's corner.
  /// @param facet area_of(segment)
  KOKKOS_INLINE_FUNCTION static Vector3 normal_at(const ContactSearch& search, int segment, int k, const Vector3& facet) {
    const ContactArrays& contact = search.contact;
    const int node = contact.segments(segment, k);
    Vector3 sum = facet;
    for (int i = contact.first_segment(node); i < contact.first_segment(node + 1); ++i) {
      const int around = contact.segment_of_node(i);
      if (around == segment) continue;
      const Vector3 other = area_of(search, around);
      if (continues(facet, other)) sum = sum + other;
    }
    return (1 / norm(sum)) * sum;
  }

  /// Where slave - r(xi, eta) is along the normal there, by Newton's iteration.
  KOKKOS_INLINE_FUNCTION static SegmentPlace reached(const SeenSegment& seen, const OverSegment& normal, SegmentPlace p) {
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Vector3 m = normal.at(p), r = seen.point(p);
      const double length = norm(m);
      const Vector3 n = (1 / length) * m;
      const double stretch = -dot(r, n) / length;
      const Vector3 a = seen.slope_xi(p.eta) + stretch * (normal.across + p.eta * normal.twist);
      const Vector3 b = seen.slope_eta(p.xi) + stretch * (normal.along + p.xi * normal.twist);
      const double scale = -1 / dot(n, cross(a, b));
      const double step_xi = scale * dot(r, cross(b, n)), step_eta = scale * dot(r, cross(n, a));
      p.xi = std::fmax(-1.5, std::fmin(1.5, p.xi + step_xi));
      p.eta = std::fmax(-1.5, std::fmin(1.5, p.eta + step_eta));
      if (std::fabs(step_xi) + std::fabs(step_eta) < 1e-9) break;
    }
    return p;
  }

  /// How far a surface with these normals at the corners stands out over the bilinear one, m: halfway to the corners' tangent
  /// planes, which is right for a circle but for its fourth order.
  KOKKOS_INLINE_FUNCTION static double bulge(const SeenSegment& seen, const Vector3 (&corner)[4], const SegmentPlace& p) {
    const Vector3 r = seen.point(p);
    double result = 0;
    for (int k = 0; k < 4; ++k) {
      const SegmentPlace there{k == 1 || k == 2 ? 1.0 : -1.0, k >= 2 ? 1.0 : -1.0};
      result += 0.5 * segment_shape(k, p.xi, p.eta) * dot(seen.point(there) - r, corner[k]);
    }
    return result;
  }
};

}  // namespace railwave
