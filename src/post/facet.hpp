#pragma once

#include <array>
#include <vector>

#include "post/field_vectors.hpp"

namespace railwave {

/// A place on a bilinear facet.
struct FacetPlace {
  int facet = -1;
  double xi = 0, eta = 0;          ///< -1 to 1 between the facet's sides
  std::array<double, 4> shares{};  ///< of the four corners: the bilinear shape functions there
  double distance = 0;             ///< m, from the point that was to be placed
  bool inside = false;             ///< its foot is on the facet, not beyond a side

  /// The vectors at the corners brought to the place.
  Vector interpolate(const ContactSide& side, const std::vector<double>& vectors) const;
};

using FacetCorners = std::array<Vector, 4>;

/// The place on a facet nearest to a point: the foot of its perpendicular, found by inverting the bilinear map, or
/// where that is beyond the facet's sides the nearest place on them. On a rectangle the shares are the products of
/// distances to the sides of thesis eq. 3.4.
FacetPlace nearest_on_facet(const FacetCorners& corners, const Vector& point);

/// Unit normal of the facet at a place, to the side from which its corners turn anticlockwise.
Vector facet_normal(const FacetCorners& corners, const FacetPlace& place);

FacetCorners facet_corners(const ContactSide& side, int facet);

/// Nodal contact stress on a side, and its mean over each facet.
struct FacetStress {
  double pressure = 0;            ///< Pa
  Vector shear = Vector::Zero();  ///< Pa, global axes
};

/// Mean contact stress of a facet, eq. 3.3 on facets of any size: every node's force is shared among the facets around
/// it by area, so a facet of area A holds A / 4 of the stress f / (nodal area) of each corner. The stresses times the
/// areas of all facets add up to the nodal forces; on squares of side l this is the sum of f / (4 l^2).
/// @param pressure Pa by node, zero where the side does not touch; shear counts at touching nodes only
FacetStress facet_stress(const ContactSide& side, int facet, const std::vector<double>& pressure);

/// m2, of the facet as it lies: of the quadrilateral of its corners.
double facet_area(const ContactSide& side, int facet);

}  // namespace railwave
