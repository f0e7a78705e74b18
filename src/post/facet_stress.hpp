#pragma once

#include <vector>

#include "post/field_vectors.hpp"

namespace railwave {

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
