#pragma once

#include <vector>

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

}  // namespace railwave
