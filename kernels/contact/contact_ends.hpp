#pragma once

#include "kernels/contact/contact_arrays.hpp"

namespace railwave {

/// What is known of the ends of a pair's two surfaces.
struct ContactEndArrays {
  Array<int* [4]> corners;  ///< of the master's facets: nodes of the model, turned outwards
  Array<int* [4]>
      beyond;  ///< of a facet's side from corner k to the next: the facet there, -1: it goes on, less: it ends
  Array<const int*> coarse_facet;  ///< 1: the facet lies outside the master's fine zone
  Array<const int*> slave_kind;  ///< by slave: 1 at an end of the surface beyond which its body's skin goes on, 2 where
                                 ///< that is coarse, 3 both
  Array<const int*> first_around;  ///< slave_count + 1
  Array<const int*> around;        ///< slaves that share a facet with a slave
  Array<int*> touched;  ///< by slave: bit 0 where it touches at this check, bit 1 where it did at the one before
};

/// The way over a surface's facets from a facet to where a place is. On the device, or on the host with mirrors of the
/// same arrays.
template <class FacetRows, class Position>
struct WayOverFacets {
  FacetRows corners, beyond;  ///< as in ContactEndArrays
  Position position;

  static constexpr int most_hops = 8;

  /// Whether it leads over an end.
  /// @param allowed m that the place may lie beyond
  /// @param facet in: where the way begins; out: the last one
  /// @param side out: of that facet, over which the way leads out; -1: the place is over that facet
  KOKKOS_INLINE_FUNCTION bool leads_out(const Vector3& place, double allowed, int& facet, int& side) const {
    for (int hop = 0; hop < most_hops; ++hop) {
      Vector3 x[4];
      for (int k = 0; k < 4; ++k) x[k] = row(position, corners(facet, k));
      const Vector3 normal = cross(x[2] - x[0], x[3] - x[1]);
      double farthest = allowed;
      side = -1;
      for (int k = 0; k < 4; ++k) {
        const Vector3 out = cross(x[(k + 1) % 4] - x[k], normal);
        const double size = norm(out);
        const double off = size > 0 ? dot(place - x[k], out) / size : 0;
        if (off > farthest) {
          farthest = off;
          side = k;
        }
      }
      if (side < 0) return false;
      const int next = beyond(facet, side);
      if (next < -1) return true;
      if (next < 0) return false;
      facet = next;
    }
    return false;
  }
};

/// How near the ends of its surfaces a contact's forces act: the largest normal force of a slave node, N; the largest
/// at an end, of a node from which the way to one beside it on the slave leads over the master's end, or which lies
/// where the slave's set ends; the largest outside the fine zones.
struct ContactEndForces {
  static constexpr int values = 3;
  /// Of the distance between two slave nodes: less than that beyond the end is not beyond it.
  static constexpr double flush = 0.05;
  ContactArrays contact;
  ContactEndArrays ends;
  Array<const double* [3]> position;

  KOKKOS_INLINE_FUNCTION void operator()(int s, double* value) const {
    for (int k = 0; k < values; ++k) value[k] = 0;
    const int facet = contact.tracked(s);
    const bool touches = contact.status(s) != status_apart && facet >= 0;
    ends.touched(s) = (ends.touched(s) << 1 | (touches ? 1 : 0)) & 3;
    if (!touches) return;
    value[0] = norm(row(contact.normal_force, s)) + 1e-300;  // it touches, even where it does not press
    const int kind = ends.slave_kind(s);
    if (kind >= 2 || ends.coarse_facet(facet) != 0) value[2] = value[0];
    if ((kind & 1) != 0 || leads_out(s, facet)) value[1] = value[0];
  }

  KOKKOS_INLINE_FUNCTION bool leads_out(int s, int facet) const {
    const WayOverFacets<Array<int* [4]>, Array<const double* [3]>> way { ends.corners, ends.beyond, position };
    const Vector3 here = row(position, contact.slave_nodes(s));
    for (int a = ends.first_around(s); a < ends.first_around(s + 1); ++a) {
      const Vector3 there = row(position, contact.slave_nodes(ends.around(a)));
      int last = facet, side;
      if (way.leads_out(there, flush * norm(there - here), last, side)) return true;
    }
    return false;
  }
};

/// Of a contact that has opened: slave nodes that touched at the last check, and how many of these are beyond an end
/// of the master now.
struct ContactEndLosses {
  static constexpr int values = 2;
  ContactArrays contact;
  ContactEndArrays ends;
  Array<const double* [3]> position;

  KOKKOS_INLINE_FUNCTION void operator()(int s, double* sum) const {
    if ((ends.touched(s) & 2) == 0) return;
    sum[0] += 1;
    int facet = contact.tracked(s), side;
    if (facet < 0) return;
    const Vector3 diagonal = row(position, ends.corners(facet, 2)) - row(position, ends.corners(facet, 0));
    const WayOverFacets<Array<int* [4]>, Array<const double* [3]>> way { ends.corners, ends.beyond, position };
    if (way.leads_out(row(position, contact.slave_nodes(s)), ContactEndForces::flush * norm(diagonal), facet, side))
      sum[1] += 1;
  }
};

/// Sum of positions of nodes from `first` on, m.
struct PositionSum {
  static constexpr int values = 3;
  Array<const double* [3]> position;
  int first;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const {
    for (int k = 0; k < 3; ++k) sum[k] += position(first + i, k);
  }
};

}  // namespace railwave
