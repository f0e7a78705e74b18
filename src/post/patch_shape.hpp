#pragma once

#include <vector>

#include "post/local_frame.hpp"
#include "post/surface_mesh.hpp"

namespace railwave {

/// Area inside the zero line of the contact pressure, m2, finer than the mesh. `pressure` in Pa by node, zero outside.
///
/// The line crosses every mesh edge that has one end in contact and one outside. Near the edge of a smooth contact the
/// pressure goes as the root of the distance, so its square is smooth, and for a Hertzian pressure a parabola along any
/// straight line: the crossing is where the parabola through the squares at the last three nodes in contact along that
/// mesh line comes to zero, but never outside the edge that it crosses. With two such nodes a straight line is drawn
/// instead of a parabola; with one the crossing is in the middle. The crossings are joined by straight lines, facet by
/// facet.
double patch_area(const ContactSide& side, const FacetsAroundNodes& around, const std::vector<double>& pressure);

/// The ellipse whose Hertzian pressure has the second moments of a patch's nodal forces: of p0 sqrt(1 - x2/a2 - y2/b2)
/// they are a2/5 and b2/5.
struct EquivalentEllipse {
  double semi_axis_along = 0,
         semi_axis_across = 0;  ///< m, along the principal axes nearest to longitudinal and lateral
  double turn = 0;              ///< rad, from -pi/4 to pi/4: by what these are turned, from along to across
};

/// @param forces N, normal, at each of `nodes`
EquivalentEllipse equivalent_ellipse(const ContactSide& side, const std::vector<int>& nodes,
                                     const std::vector<double>& forces, const LocalFrame& frame);

}  // namespace railwave
