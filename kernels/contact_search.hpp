#pragma once

#include "kernels/contact_arrays.hpp"

namespace railwave {

/// Where a slave node stands over the master surface.
struct Projection {
  int segment;       ///< -1: beside the surface
  double xi, eta;
  double gap;        ///< along the normal, m; negative: penetration
  Vector3 point;     ///< contact point r(xi, eta)
  Vector3 normal;    ///< outward unit normal of the master there
};

/// Search of thesis 2.6.1: closest master node (tracked), the segment around it that holds the slave's projection
/// (eq. 2.23, last step's segment first), the contact point by Newton iteration (eq. 2.25), the penetration (eq. 2.26a).
struct ContactSearch {
  ContactArrays contact;
  Array<const double* [3]> position;

  /// A projection may lie this far outside a segment, in xi or eta, and still belong to the surface: on a convex fold
  /// a penetrating node can be outside both neighbours.
  static constexpr double outside_tolerance = 0.05;
  static constexpr double on_segment = 1e-12;

  KOKKOS_INLINE_FUNCTION Vector3 master(int m) const { return row(position, contact.master_nodes(m)); }

  KOKKOS_INLINE_FUNCTION void corners_of(int segment, Vector3 (&corner)[4]) const {
    for (int k = 0; k < 4; ++k) corner[k] = master(contact.segments(segment, k));
  }

  /// Walks over the mesh from the last closest node to the nearest one around.
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
          if (distance < least) {
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

  /// Contact point on one segment by Newton iteration on the squared distance (eq. 2.25).
  KOKKOS_INLINE_FUNCTION Projection project(const Vector3& slave, int segment) const {
    Vector3 corner[4];
    corners_of(segment, corner);
    double xi = 0, eta = 0;
    Vector3 along_xi, along_eta, r;
    const Vector3 twist = 0.25 * ((corner[0] - corner[1]) + (corner[2] - corner[3]));
    for (int iteration = 0; iteration < 12; ++iteration) {
      r = segment_point(corner, xi, eta);
      along_xi = (0.25 * (1 - eta)) * (corner[1] - corner[0]) + (0.25 * (1 + eta)) * (corner[2] - corner[3]);
      along_eta = (0.25 * (1 - xi)) * (corner[3] - corner[0]) + (0.25 * (1 + xi)) * (corner[2] - corner[1]);
      const Vector3 d = slave - r, n = cross(along_xi, along_eta);
      // Of d.twist only the part along the normal, all that is left of d at the contact point: with d whole the first
      // iterations can miss on distorted segments.
      const double curvature = dot(d, n) * dot(n, twist) / dot(n, n);
      const double a = dot(along_xi, along_xi), b = dot(along_xi, along_eta) - curvature;
      const double c = dot(along_eta, along_eta);
      const double p = dot(along_xi, d), q = dot(along_eta, d);
      const double step_xi = (c * p - b * q) / (a * c - b * b), step_eta = (a * q - b * p) / (a * c - b * b);
      // A slave far beside a warped segment must not send the iteration to infinity.
      xi = std::fmax(-3.0, std::fmin(3.0, xi + step_xi));
      eta = std::fmax(-3.0, std::fmin(3.0, eta + step_eta));
      if (std::fabs(step_xi) + std::fabs(step_eta) < 1e-13) break;
    }
    return finish(slave, segment, corner, xi, eta);
  }

  KOKKOS_INLINE_FUNCTION static Projection finish(const Vector3& slave, int segment, const Vector3 (&corner)[4], double xi,
                                                  double eta) {
    Projection result;
    const Vector3 along_xi = (1 - eta) * (corner[1] - corner[0]) + (1 + eta) * (corner[2] - corner[3]);
    const Vector3 along_eta = (1 - xi) * (corner[3] - corner[0]) + (1 + xi) * (corner[2] - corner[1]);
    const Vector3 normal = cross(along_xi, along_eta);
    result.segment = segment;
    result.xi = xi;
    result.eta = eta;
    result.point = segment_point(corner, xi, eta);
    result.normal = (1.0 / norm(normal)) * normal;
    result.gap = dot(result.normal, slave - result.point);
    return result;
  }

  KOKKOS_INLINE_FUNCTION static double outside(const Projection& p) {
    return std::fmax(std::fabs(p.xi), std::fabs(p.eta)) - 1.0;
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

  /// @param previous segment touched at the last step, -1: none
  KOKKOS_INLINE_FUNCTION Projection locate(const Vector3& slave, int node, int previous) const {
    const int begin = contact.first_segment(node), end = contact.first_segment(node + 1);
    int chosen = -1;
    for (int s = begin; s < end && chosen < 0; ++s)
      if (contact.segment_of_node(s) == previous && between_edges(slave, node, previous)) chosen = previous;
    for (int s = begin; s < end && chosen < 0; ++s)
      if (between_edges(slave, node, contact.segment_of_node(s))) chosen = contact.segment_of_node(s);

    Projection best{};
    double least = 1e300;
    if (chosen >= 0) {
      best = project(slave, chosen);
      least = outside(best);
    }
    // Folds, warped and slender segments: the test with plane edges and the true projection can disagree, and on a
    // disordered mesh the segment that holds the projection need not touch the closest node.
    if (least > on_segment) try_around(slave, node, chosen, best, least);
    for (int s = begin; s < end && least > on_segment; ++s)
      for (int k = 0; k < 4 && least > on_segment; ++k) {
        const int other = contact.segments(contact.segment_of_node(s), k);
        if (other != node) try_around(slave, other, chosen, best, least);
      }
    if (least > outside_tolerance) {
      best.segment = -1;
    } else if (least > 0) {
      Vector3 corner[4];
      corners_of(best.segment, corner);
      best = finish(slave, best.segment, corner, std::fmax(-1.0, std::fmin(1.0, best.xi)),
                    std::fmax(-1.0, std::fmin(1.0, best.eta)));
    }
    return best;
  }
};

}  // namespace railwave
