#pragma once

#include "kernels/contact/contact_search.hpp"

namespace railwave {

/// A contact pushes along the normal of the facet that it is on, which jumps from facet to facet.
struct FacetNormals {
  static constexpr bool curved = false;

  KOKKOS_INLINE_FUNCTION static Projection turned(const ContactSearch& /*search*/, const Vector3& /*slave*/,
                                                  const Projection& found) {
    return found;
  }
  /// The contact point at a place of a segment less the slave's position, m.
  KOKKOS_INLINE_FUNCTION static Vector3 point(const ContactSearch& search, const Vector3& slave, int segment,
                                              const SegmentPlace& place) {
    return search.see(slave, segment).point(place);
  }
  /// What moves the contact point at a place that stays where it is in the segment, of the nodes' `field`: m of
  /// displacements, m/s of velocities.
  template <class Field>
  KOKKOS_INLINE_FUNCTION static Vector3 carried(const ContactSearch& search, int segment, const SegmentPlace& place,
                                                const Field& field) {
    const Segment s = search.contact.surface(segment);
    Vector3 result{{0, 0, 0}};
    for (int k = 0; k < 4; ++k)
      result = result + segment_shape(k, place.xi, place.eta) * search.at_corner(field, s.node[k]);
    return result;
  }
};

/// The step that led to the present positions.
struct LastStep {
  Array<const double* [3]> velocity;  ///< m/s
  double elapsed;                     ///< s; 0: no motion has led here

  /// How a node has moved relative to the place of a segment that it was over, m.
  template <class Normals = FacetNormals>
  KOKKOS_INLINE_FUNCTION Vector3 relative_motion(const ContactSearch& search, int node, int segment,
                                                 const SegmentPlace& place) const {
    return elapsed * (row(velocity, node) - Normals::carried(search, segment, place, velocity));
  }

  /// How far a node in contact has slid over the master, m: de of the contact point (thesis eq. 2.28). A contact point
  /// that is clamped to an open side stays behind its node, and where the node is off now there is none.
  template <class Normals>
  KOKKOS_INLINE_FUNCTION Vector3 slid(const ContactSearch& search, int node, const Vector3& slave, int segment,
                                      const SegmentPlace& place, const Projection& now, bool touches) const {
    if (elapsed > 0 &&
        (!touches || search.at_open_side(segment, place) || search.at_open_side(now.segment, now.place))) {
      const Vector3 way = relative_motion<Normals>(search, node, segment, place);
      return touches ? way - dot(way, now.normal) * now.normal : way;
    }
    return now.offset - Normals::point(search, slave, segment, place);
  }
};

/// A segment curved between its corners such that it is normal to a given direction at each. Its sides are cubic: at
/// corner k the side to corner j begins along x_j - x_k less its part along the normal n_k, and what that adds to the
/// chord is blended linearly into the segment:
///   S = r - sum_k n_k (n_k . E_k),  E_k = h(tau) (1 - sigma) (x_j - x_k) + h(sigma) (1 - tau) (x_l - x_k),  h(t) = t
///   (1 - t)^2,
/// r the bilinear surface, tau and sigma the way from corner k to its neighbours j and l along xi and eta, from 0 to 1.
/// A side depends on its own two corners only, so that neighbours meet.
struct CurvedSegment {
  SeenSegment seen;
  Vector3 normal[4];
  double rise_xi[4], rise_eta[4];  ///< m, along a corner's normal to its neighbour along xi, along eta

  KOKKOS_INLINE_FUNCTION static double sign_xi(int k) { return k == 1 || k == 2 ? 1.0 : -1.0; }
  KOKKOS_INLINE_FUNCTION static double sign_eta(int k) { return k >= 2 ? 1.0 : -1.0; }
  KOKKOS_INLINE_FUNCTION static int beside_xi(int k) { return k ^ 1; }
  KOKKOS_INLINE_FUNCTION static int beside_eta(int k) { return 3 - k; }
  KOKKOS_INLINE_FUNCTION static double h(double t) { return t * (1 - t) * (1 - t); }
  KOKKOS_INLINE_FUNCTION static double h_slope(double t) { return (1 - t) * (1 - 3 * t); }
  KOKKOS_INLINE_FUNCTION static double h_curve(double t) { return 6 * t - 4; }

  KOKKOS_INLINE_FUNCTION CurvedSegment(const SeenSegment& flat, const Vector3 (&normals)[4]) : seen(flat) {
    for (int k = 0; k < 4; ++k) {
      const double sx = sign_xi(k), sy = sign_eta(k);
      normal[k] = normals[k];
      rise_xi[k] = -2 * sx * dot(normal[k], seen.slope_xi(sy));
      rise_eta[k] = -2 * sy * dot(normal[k], seen.slope_eta(sx));
    }
  }

  /// Weights of the ways to a corner's neighbours along xi and eta in E_k.
  KOKKOS_INLINE_FUNCTION static void weights(int k, const SegmentPlace& p, double& along_xi, double& along_eta) {
    const double tau = 0.5 * (1 - sign_xi(k) * p.xi), sigma = 0.5 * (1 - sign_eta(k) * p.eta);
    along_xi = h(tau) * (1 - sigma);
    along_eta = h(sigma) * (1 - tau);
  }

  KOKKOS_INLINE_FUNCTION Vector3 point(const SegmentPlace& p) const {
    Vector3 result = seen.point(p);
    for (int k = 0; k < 4; ++k) {
      double along_xi, along_eta;
      weights(k, p, along_xi, along_eta);
      result = result - (along_xi * rise_xi[k] + along_eta * rise_eta[k]) * normal[k];
    }
    return result;
  }

  KOKKOS_INLINE_FUNCTION void slopes(const SegmentPlace& p, Vector3& slope_xi, Vector3& slope_eta) const {
    slope_xi = seen.slope_xi(p.eta);
    slope_eta = seen.slope_eta(p.xi);
    for (int k = 0; k < 4; ++k) {
      const double sx = sign_xi(k), sy = sign_eta(k), tau = 0.5 * (1 - sx * p.xi), sigma = 0.5 * (1 - sy * p.eta);
      slope_xi = slope_xi + (0.5 * sx * (h_slope(tau) * (1 - sigma) * rise_xi[k] - h(sigma) * rise_eta[k])) * normal[k];
      slope_eta = slope_eta + (0.5 * sy * (h_slope(sigma) * (1 - tau) * rise_eta[k] - h(tau) * rise_xi[k])) * normal[k];
    }
  }

  /// The place whose point is nearest to the slave, by Newton's iteration on the squared distance from a place nearby.
  KOKKOS_INLINE_FUNCTION SegmentPlace nearest(SegmentPlace p) const {
    for (int iteration = 0; iteration < 10; ++iteration) {
      const Vector3 r = point(p);
      Vector3 a, b;
      slopes(p, a, b);
      double bend_xi = 0, bend_eta = 0, bend_mixed = dot(r, seen.twist);
      for (int k = 0; k < 4; ++k) {
        const double sx = sign_xi(k), sy = sign_eta(k), tau = 0.5 * (1 - sx * p.xi), sigma = 0.5 * (1 - sy * p.eta);
        const double across = 0.25 * dot(r, normal[k]);
        bend_xi -= across * h_curve(tau) * (1 - sigma) * rise_xi[k];
        bend_eta -= across * h_curve(sigma) * (1 - tau) * rise_eta[k];
        bend_mixed += across * sx * sy * (h_slope(tau) * rise_xi[k] + h_slope(sigma) * rise_eta[k]);
      }
      const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), flat = aa * bb - ab * ab;
      double xx = aa + bend_xi, yy = bb + bend_eta, xy = ab + bend_mixed, determinant = xx * yy - xy * xy;
      if (!(determinant > 0.1 * flat) ||
          !(xx > 0)) {  // far off, where the nearest point of the tangent plane leads nearer
        xx = aa;
        yy = bb;
        xy = ab;
        determinant = flat;
      }
      const double ar = dot(a, r), br = dot(b, r);
      const double step_xi = (xy * br - yy * ar) / determinant, step_eta = (xy * ar - xx * br) / determinant;
      p.xi = std::fmax(-1.5, std::fmin(1.5, p.xi + step_xi));
      p.eta = std::fmax(-1.5, std::fmin(1.5, p.eta + step_eta));
      if (std::fabs(step_xi) + std::fabs(step_eta) < 1e-9) break;
    }
    return p;
  }
};

/// A contact pushes along a normal that is continuous from facet to facet: the facets are curved such that the surface
/// is normal, at each node, to the mean of the facets around, weighted by their areas. The contact point is the nearest
/// one of that surface. So the gap's gradient is the normal at the slave and, at the master's nodes, what moving them
/// does to the contact point: contact forces spread by reaction() do as much work as the springs store, and balance in
/// sum and in moment. Facets that meet at more than 30 degrees make an edge: each has its own normal there.
struct SmoothNormals {
  static constexpr bool curved = true;
  static constexpr double same_surface = 0.866;  ///< cosine of that angle
  static constexpr double near_share = 0.1;      ///< of the segment's diagonal: nodes farther off cannot touch
  static constexpr int most_hops = 3;

  KOKKOS_INLINE_FUNCTION static Projection turned(const ContactSearch& search, const Vector3& slave, Projection found) {
    if (!is_distance(found.gap) || found.at_edge) return found;
    SeenSegment seen = search.see(slave, found.segment);
    if (found.gap > near_share * 2 * norm(seen.across + seen.along)) return found;
    int from = -1;
    for (int hop = 0; hop < most_hops; ++hop) {
      const CurvedSegment surface = curved_segment(search, seen);
      const SegmentPlace place = surface.nearest(found.place);
      found.place = place.clamped();
      Vector3 a, b;
      surface.slopes(found.place, a, b);
      const Vector3 n = cross(a, b);
      found.normal = (1 / norm(n)) * n;
      found.offset = surface.point(found.place);
      found.gap = -dot(found.normal, found.offset);
      if (place.outside() <= ContactProjection::on_segment) break;
      const int next = search.contact.surface(found.segment).beyond(ContactProjection::side_towards(place));
      if (next < 0 || next == from || hop + 1 == most_hops ||
          !continues(area_of(search, found.segment), area_of(search, next)))
        break;
      from = found.segment;
      found.segment = next;
      seen = search.see(slave, next);
      found.place = ContactProjection::nearest_place(seen, {0, 0}).clamped();
    }
    return found;
  }

  /// The contact point at a place of a segment less the slave's position, m.
  KOKKOS_INLINE_FUNCTION static Vector3 point(const ContactSearch& search, const Vector3& slave, int segment,
                                              const SegmentPlace& place) {
    return curved_segment(search, search.see(slave, segment)).point(place);
  }

  /// Shares out among the master's nodes a force at a contact point: to each what the force does when that node moves,
  /// (dS/dx)^T f.
  /// @param give called as give.corners(share) with what goes to the segment's own nodes, Vector3[4], which add up to
  /// the force; and as
  ///   give.pair(plus, minus, share) for further nodes, by a Segment's numbers of corners: `share` to one and its
  ///   opposite to another.
  template <class Give>
  KOKKOS_INLINE_FUNCTION static void reaction(const ContactSearch& search, int segment, const SegmentPlace& place,
                                              const Vector3& force, const Give& give) {
    const Segment s = search.contact.surface(segment);
    Vector3 x[4], share[4];
    for (int k = 0; k < 4; ++k) {
      x[k] = search.at_corner(search.position, s.node[k]);
      share[k] = segment_shape(k, place.xi, place.eta) * force;
    }
    const Vector3 facet = cross(x[2] - x[0], x[3] - x[1]);
    for (int k = 0; k < 4; ++k) {
      const Corner corner(search, segment, k, facet, x, place);
      const Vector3 n = corner.normal;
      const double pressing = dot(force, n);
      const int j = CurvedSegment::beside_xi(k), l = CurvedSegment::beside_eta(k);
      const Vector3 along_xi = (corner.along_xi * pressing) * n, along_eta = (corner.along_eta * pressing) * n;
      share[j] = share[j] - along_xi;
      share[l] = share[l] - along_eta;
      share[k] = share[k] + along_xi + along_eta;
      Vector3 turning = pressing * corner.way + dot(n, corner.way) * force;
      turning = (-1 / corner.area) * (turning - dot(turning, n) * n);
      for (int i = corner.first; i < corner.last; ++i) {
        const int around = search.contact.segment_of_node(i);
        if (!belongs(search, around, segment, facet)) continue;
        const Segment other = search.contact.surface(around);
        const Vector3 first =
            search.at_corner(search.position, other.node[2]) - search.at_corner(search.position, other.node[0]);
        const Vector3 second =
            search.at_corner(search.position, other.node[3]) - search.at_corner(search.position, other.node[1]);
        give.pair(other.node[2], other.node[0], cross(second, turning));
        give.pair(other.node[3], other.node[1], cross(turning, first));
      }
    }
    give.corners(share);
  }

  /// What moves the contact point at a place that stays where it is in the segment, of the nodes' `field`: m of
  /// displacements, m/s of velocities.
  template <class Field>
  KOKKOS_INLINE_FUNCTION static Vector3 carried(const ContactSearch& search, int segment, const SegmentPlace& place,
                                                const Field& field) {
    const Segment s = search.contact.surface(segment);
    Vector3 x[4], v[4], result{{0, 0, 0}};
    for (int k = 0; k < 4; ++k) {
      x[k] = search.at_corner(search.position, s.node[k]);
      v[k] = search.at_corner(field, s.node[k]);
      result = result + segment_shape(k, place.xi, place.eta) * v[k];
    }
    const Vector3 facet = cross(x[2] - x[0], x[3] - x[1]);
    for (int k = 0; k < 4; ++k) {
      const Corner corner(search, segment, k, facet, x, place);
      const Vector3 n = corner.normal;
      const Vector3 way = corner.along_xi * (v[CurvedSegment::beside_xi(k)] - v[k]) +
                          corner.along_eta * (v[CurvedSegment::beside_eta(k)] - v[k]);
      Vector3 turning{{0, 0, 0}};
      for (int i = corner.first; i < corner.last; ++i) {
        const int around = search.contact.segment_of_node(i);
        if (!belongs(search, around, segment, facet)) continue;
        const Segment other = search.contact.surface(around);
        const Vector3 first =
            search.at_corner(search.position, other.node[2]) - search.at_corner(search.position, other.node[0]);
        const Vector3 second =
            search.at_corner(search.position, other.node[3]) - search.at_corner(search.position, other.node[1]);
        turning = turning +
                  cross(search.at_corner(field, other.node[2]) - search.at_corner(field, other.node[0]), second) +
                  cross(first, search.at_corner(field, other.node[3]) - search.at_corner(field, other.node[1]));
      }
      turning = (1 / corner.area) * (turning - dot(turning, n) * n);
      result = result - (dot(n, way) + dot(turning, corner.way)) * n - dot(n, corner.way) * turning;
    }
    return result;
  }

  KOKKOS_INLINE_FUNCTION static bool continues(const Vector3& facet, const Vector3& other) {
    return dot(facet, other) > same_surface * norm(facet) * norm(other);
  }

  /// Outwards, as long as the segment's area twice.
  KOKKOS_INLINE_FUNCTION static Vector3 area_of(const ContactSearch& search, int segment) {
    const Segment s = search.contact.surface(segment);
    return cross(search.diagonal(s),
                 search.at_corner(search.position, s.node[3]) - search.at_corner(search.position, s.node[1]));
  }

 private:
  /// Whether a segment at a corner of another, which may be itself, has part in the normal there.
  /// @param facet area_of(segment)
  KOKKOS_INLINE_FUNCTION static bool belongs(const ContactSearch& search, int around, int segment,
                                             const Vector3& facet) {
    return around == segment || continues(facet, area_of(search, around));
  }

  /// Sum of the areas of these segments, twice.
  KOKKOS_INLINE_FUNCTION static Vector3 area_at(const ContactSearch& search, int segment, int k, const Vector3& facet) {
    const ContactArrays& contact = search.contact;
    const int node = contact.segments(segment, k);
    Vector3 sum{{0, 0, 0}};
    for (int i = contact.first_segment(node); i < contact.first_segment(node + 1); ++i) {
      const Vector3 area = area_of(search, contact.segment_of_node(i));
      if (contact.segment_of_node(i) == segment || continues(facet, area)) sum = sum + area;
    }
    return sum;
  }

  KOKKOS_INLINE_FUNCTION static CurvedSegment curved_segment(const ContactSearch& search, const SeenSegment& seen) {
    const Vector3 facet = area_of(search, seen.segment);
    Vector3 normal[4];
    for (int k = 0; k < 4; ++k) {
      const Vector3 area = area_at(search, seen.segment, k, facet);
      normal[k] = (1 / norm(area)) * area;
    }
    return CurvedSegment(seen, normal);
  }

  /// What a corner does to the contact point.
  struct Corner {
    int first, last;  ///< of the segments around it
    double area;      ///< m2, length of area_at()
    Vector3 normal;
    double along_xi, along_eta;  ///< weights of the ways to its neighbours
    Vector3 way;                 ///< m, E_k: these ways by their weights

    KOKKOS_INLINE_FUNCTION Corner(const ContactSearch& search, int segment, int k, const Vector3& facet,
                                  const Vector3 (&x)[4], const SegmentPlace& place) {
      const int node = search.contact.segments(segment, k);
      first = search.contact.first_segment(node);
      last = search.contact.first_segment(node + 1);
      const Vector3 sum = area_at(search, segment, k, facet);
      area = norm(sum);
      normal = (1 / area) * sum;
      CurvedSegment::weights(k, place, along_xi, along_eta);
      way = along_xi * (x[CurvedSegment::beside_xi(k)] - x[k]) + along_eta * (x[CurvedSegment::beside_eta(k)] - x[k]);
    }
  };
};

}  // namespace railwave
