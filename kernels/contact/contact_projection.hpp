#pragma once

#include "kernels/contact/contact_arrays.hpp"

namespace railwave {

/// A place on a segment's bilinear surface, within its sides or beyond them.
struct SegmentPlace {
  double xi, eta;

  /// How far outside the segment, in xi or eta; at most 0: inside.
  KOKKOS_INLINE_FUNCTION double outside() const { return std::fmax(std::fabs(xi), std::fabs(eta)) - 1.0; }
  KOKKOS_INLINE_FUNCTION SegmentPlace clamped() const {
    return {std::fmax(-1.0, std::fmin(1.0, xi)), std::fmax(-1.0, std::fmin(1.0, eta))};
  }
};

/// Where a slave node stands over a segment of the master surface.
struct Projection {
  int segment;  ///< -1: beside the surface
  SegmentPlace place;
  double gap;      ///< along the normal, m; negative: penetration
  Vector3 offset;  ///< contact point r(xi, eta) less the slave's position, m
  Vector3
      normal;  ///< outward unit normal of the master there; at a sharp edge or corner, the way to the slave or from it
  bool at_edge = false;  ///< at such a one
};

/// The place of a segment that is nearest to a slave.
struct NearestPlace {
  SegmentPlace place;  ///< within the segment's sides
  double squared;      ///< m2, distance
  double outside;      ///< how far outside the segment the slave's projection lies, in xi or eta; at most 0: inside

  /// Farther than any.
  KOKKOS_INLINE_FUNCTION static NearestPlace none() { return {{0, 0}, 1e300, 1e300}; }
};

/// A segment seen from a slave node: small numbers, whose rounding does not disturb the iteration. r(xi, eta) less the
/// slave's position is middle + xi across + eta along + xi eta twist (eq. 2.24).
struct SeenSegment {
  int segment;
  Vector3 middle, across, along, twist;  ///< m

  KOKKOS_INLINE_FUNCTION Vector3 point(const SegmentPlace& p) const {
    return middle + p.xi * (across + p.eta * twist) + p.eta * along;
  }
  KOKKOS_INLINE_FUNCTION Vector3 corner(int k) const {
    return point({k == 1 || k == 2 ? 1.0 : -1.0, k >= 2 ? 1.0 : -1.0});
  }
  /// m2, no more than the squared distance of the slave from any place of the segment: that from its corners' box.
  KOKKOS_INLINE_FUNCTION double least_squared_distance() const {
    double squared = 0;
    for (int i = 0; i < 3; ++i) {
      const double reach = std::fabs(across[i]) + std::fabs(along[i]) + std::fabs(twist[i]);
      const double outside = std::fmax(0.0, std::fabs(middle[i]) - reach);
      squared += outside * outside;
    }
    return squared;
  }
  KOKKOS_INLINE_FUNCTION Vector3 slope_xi(double eta) const { return across + eta * twist; }
  KOKKOS_INLINE_FUNCTION Vector3 slope_eta(double xi) const { return along + xi * twist; }
};

/// Projection of slave nodes on single segments.
struct ContactProjection {
  ContactArrays contact;
  Array<const double* [3]> position;

  static constexpr double on_segment = 1e-12;  ///< `outside` up to this is rounding
  /// A projection may lie this far outside a segment, in xi or eta, and still belong to the surface that ends there:
  /// the edges of bodies of one size stay on each other while they bulge.
  static constexpr double outside_tolerance = 0.05;

  /// What the nodes of a mouth's corner have of it.
  KOKKOS_INLINE_FUNCTION void shares_of(const MouthCorner& mouth, double (&share)[MouthCorner::pieces]) const {
    const double half = mouth.share[1] + mouth.share[2];
    const Vector3 way = (mouth.share[1] / half) * row(position, mouth.node[1]) +
                        (mouth.share[2] / half) * row(position, mouth.node[2]) - row(position, mouth.node[0]);
    const double together = std::fmax(0.0, std::fmin(1.0, 2 - norm(way) / mouth.widest));
    share[1] = together * mouth.share[1];
    share[2] = together * mouth.share[2];
    share[0] = 1 - share[1] - share[2];
  }

  /// A vector of the nodes, such as their positions, at a segment's corner.
  KOKKOS_INLINE_FUNCTION Vector3 at_corner(const Array<const double* [3]>& values, int corner) const {
    if (corner >= 0) return row(values, corner);
    const MouthCorner mouth = contact.mouth_corners(-1 - corner);
    double share[MouthCorner::pieces];
    shares_of(mouth, share);
    return share[0] * row(values, mouth.node[0]) +
           (share[1] * row(values, mouth.node[1]) + share[2] * row(values, mouth.node[2]));
  }

  /// From a segment's first corner to the opposite one, m.
  KOKKOS_INLINE_FUNCTION Vector3 diagonal(const Segment& segment) const {
    return at_corner(position, segment.node[2]) - at_corner(position, segment.node[0]);
  }

  /// Whether a place lies at a side beyond which there is no surface, or may have been clamped to it.
  KOKKOS_INLINE_FUNCTION bool at_open_side(int segment, const SegmentPlace& p) const {
    if (segment < 0 || std::fmax(std::fabs(p.xi), std::fabs(p.eta)) < 1) return false;
    const Segment s = contact.surface(segment);
    return (p.eta <= -1 && s.link[0] < 0) || (p.xi >= 1 && s.link[1] < 0) || (p.eta >= 1 && s.link[2] < 0) ||
           (p.xi <= -1 && s.link[3] < 0);
  }

  KOKKOS_INLINE_FUNCTION SeenSegment see(const Vector3& slave, int segment) const {
    const Segment s = contact.surface(segment);
    Vector3 corner[4];
    for (int k = 0; k < 4; ++k) corner[k] = at_corner(position, s.node[k]) - slave;
    const Vector3 low = corner[0] + corner[1], high = corner[3] + corner[2];
    const Vector3 low_way = corner[1] - corner[0], high_way = corner[2] - corner[3];
    return {segment, 0.25 * (low + high), 0.25 * (low_way + high_way), 0.25 * (high - low),
            0.25 * (high_way - low_way)};
  }

  /// Contact point by Newton iteration on the squared distance (eq. 2.25), from a place nearby.
  KOKKOS_INLINE_FUNCTION static SegmentPlace nearest_place(const SeenSegment& seen, const SegmentPlace& start) {
    double xi = start.xi, eta = start.eta;
    for (int iteration = 0; iteration < 12; ++iteration) {
      const Vector3 r = seen.point({xi, eta}), slope_xi = seen.slope_xi(eta), slope_eta = seen.slope_eta(xi);
      const Vector3 n = cross(slope_xi, slope_eta);
      const double a = dot(slope_xi, slope_xi), c = dot(slope_eta, slope_eta), area = dot(n, n);
      // Of the distance times twist only the part along the normal, all that is left of it at the contact point: with
      // the distance whole the first iterations can miss on distorted segments. Multiplied by `area` throughout, so
      // that one division does.
      const double b = dot(slope_xi, slope_eta) * area + dot(r, n) * dot(n, seen.twist);
      const double p = dot(slope_xi, r), q = dot(slope_eta, r);
      const double scale = area / (b * b - a * c * area * area);
      const double step_xi = scale * (c * p * area - b * q), step_eta = scale * (a * q * area - b * p);
      // A slave far beside a warped segment must not send the iteration to infinity.
      xi = std::fmax(-3.0, std::fmin(3.0, xi + step_xi));
      eta = std::fmax(-3.0, std::fmin(3.0, eta + step_eta));
      // Convergence is quadratic: after such a step the error is of the order of its square, 1e-14.
      if (std::fabs(step_xi) + std::fabs(step_eta) < 1e-7) break;
    }
    return {xi, eta};
  }

  /// The nearest place of a segment, wherever the slave is. Where the projection lies outside, one of the four straight
  /// sides has it: xi and eta do not show which one on a slanted segment.
  KOKKOS_INLINE_FUNCTION static NearestPlace nearest_within(const SeenSegment& seen) {
    const SegmentPlace projected = nearest_place(seen, {0, 0});
    NearestPlace best{projected, 0, projected.outside()};
    Vector3 offset = seen.point(projected);
    best.squared = dot(offset, offset);
    if (best.outside <= 0) return best;
    best.squared = 1e300;
    Vector3 from = seen.corner(0);
    for (int side = 0; side < 4; ++side) {
      const Vector3 to = seen.corner((side + 1) % 4), way = to - from;
      const double share = std::fmax(0.0, std::fmin(1.0, -dot(from, way) / dot(way, way)));
      offset = from + share * way;
      const double squared = dot(offset, offset), along = 2 * share - 1;
      if (squared < best.squared) {
        best.squared = squared;
        best.place = side == 0   ? SegmentPlace{along, -1}
                     : side == 1 ? SegmentPlace{1, along}
                     : side == 2 ? SegmentPlace{-along, 1}
                                 : SegmentPlace{-1, -along};
      }
      from = to;
    }
    return best;
  }

  /// The side that a place lies farthest beyond.
  KOKKOS_INLINE_FUNCTION static int side_towards(const SegmentPlace& p) {
    const bool along_xi = std::fabs(p.xi) >= std::fabs(p.eta);
    return along_xi ? (p.xi > 0 ? 1 : 3) : (p.eta > 0 ? 2 : 0);
  }

  KOKKOS_INLINE_FUNCTION static Projection at(const SeenSegment& seen, const SegmentPlace& place) {
    Projection result;
    const Vector3 normal = cross(seen.slope_xi(place.eta), seen.slope_eta(place.xi));
    result.segment = seen.segment;
    result.place = place;
    result.offset = seen.point(place);
    result.normal = (1.0 / norm(normal)) * normal;
    result.gap = -dot(result.normal, result.offset);
    return result;
  }
};

}  // namespace railwave
