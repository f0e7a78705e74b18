#pragma once

#include <vector>

#include "post/local_frame.hpp"

namespace railwave {

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
