#pragma once

#include "kernels/contact_arrays.hpp"

namespace railwave {

/// Where a slave node stands over a segment of the master surface.
struct Projection {
  int segment;       ///< -1: beside the surface
  double xi, eta;
  double gap;        ///< along the normal, m; negative: penetration
  Vector3 offset;    ///< contact point r(xi, eta) less the slave's position, m
  Vector3 normal;    ///< outward unit normal of the master there
};

/// How far outside its segment a projection lies, in xi or eta; at most 0: inside.
KOKKOS_INLINE_FUNCTION double outside(const Projection& p) {
  return std::fmax(std::fabs(p.xi), std::fabs(p.eta)) - 1.0;
}

/// Projection of slave nodes on single segments.
struct ContactProjection {
  ContactArrays contact;
  Array<const double* [3]> position;

  static constexpr double on_segment = 1e-12;  ///< `outside` up to this is rounding

  /// A segment's corners less the slave's position: small numbers, whose rounding does not disturb the iteration.
  KOKKOS_INLINE_FUNCTION void corners_from(const Vector3& slave, int segment, Vector3 (&corner)[4]) const {
    const Segment s = contact.surface(segment);
    for (int k = 0; k < 4; ++k) corner[k] = row(position, s.node[k]) - slave;
  }

  /// Contact point on one segment by Newton iteration on the squared distance (eq. 2.25), from a place nearby.
  KOKKOS_INLINE_FUNCTION Projection project(const Vector3& slave, int segment, double xi = 0, double eta = 0) const {
    Vector3 corner[4];
    corners_from(slave, segment, corner);
    const Vector3 twist = 0.25 * ((corner[0] - corner[1]) + (corner[2] - corner[3]));
    for (int iteration = 0; iteration < 12; ++iteration) {
      const Vector3 r = segment_point(corner, xi, eta);
      const Vector3 along_xi = (0.25 * (1 - eta)) * (corner[1] - corner[0]) + (0.25 * (1 + eta)) * (corner[2] - corner[3]);
      const Vector3 along_eta = (0.25 * (1 - xi)) * (corner[3] - corner[0]) + (0.25 * (1 + xi)) * (corner[2] - corner[1]);
      const Vector3 n = cross(along_xi, along_eta);
      const double a = dot(along_xi, along_xi), c = dot(along_eta, along_eta), area = dot(n, n);
      // Of the distance times twist only the part along the normal, all that is left of it at the contact point: with the
      // distance whole the first iterations can miss on distorted segments. Multiplied by `area` throughout, so that one
      // division does.
      const double b = dot(along_xi, along_eta) * area + dot(r, n) * dot(n, twist);
      const double p = dot(along_xi, r), q = dot(along_eta, r);
      const double scale = area / (b * b - a * c * area * area);
      const double step_xi = scale * (c * p * area - b * q), step_eta = scale * (a * q * area - b * p);
      // A slave far beside a warped segment must not send the iteration to infinity.
      xi = std::fmax(-3.0, std::fmin(3.0, xi + step_xi));
      eta = std::fmax(-3.0, std::fmin(3.0, eta + step_eta));
      // Convergence is quadratic: after such a step the error is of the order of its square, 1e-14.
      if (std::fabs(step_xi) + std::fabs(step_eta) < 1e-7) break;
    }
    return finish(segment, corner, xi, eta);
  }

  /// The nearest place within the segment's sides of a projection beyond them.
  KOKKOS_INLINE_FUNCTION Projection clamped(const Vector3& slave, const Projection& beyond) const {
    Vector3 corner[4];
    corners_from(slave, beyond.segment, corner);
    return finish(beyond.segment, corner, std::fmax(-1.0, std::fmin(1.0, beyond.xi)),
                  std::fmax(-1.0, std::fmin(1.0, beyond.eta)));
  }

  KOKKOS_INLINE_FUNCTION static Projection finish(int segment, const Vector3 (&corner)[4], double xi, double eta) {
    Projection result;
    const Vector3 along_xi = (1 - eta) * (corner[1] - corner[0]) + (1 + eta) * (corner[2] - corner[3]);
    const Vector3 along_eta = (1 - xi) * (corner[3] - corner[0]) + (1 + xi) * (corner[2] - corner[1]);
    const Vector3 normal = cross(along_xi, along_eta);
    result.segment = segment;
    result.xi = xi;
    result.eta = eta;
    result.offset = segment_point(corner, xi, eta);
    result.normal = (1.0 / norm(normal)) * normal;
    result.gap = -dot(result.normal, result.offset);
    return result;
  }
};

}  // namespace railwave
