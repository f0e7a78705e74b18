#pragma once

#include <vector>

#include "post/surface_search.hpp"

namespace railwave {

/// Motion of a slave node relative to the place of the master that it is in contact with, thesis 3.4.2.
struct RelativeMotion {
  bool known = false;            ///< the node stands over the master surface
  Vector slip = Vector::Zero();  ///< m/s, in the master's tangent plane (eq. 3.5)
  double parting = 0;            ///< m/s along the master's outward normal: positive where the surfaces part
};

/// Of each of `nodes` of the slave. The master's velocity is interpolated at the node's projection (eq. 3.4, with the
/// inverse of the bilinear map in place of the distances to the sides, so that it holds on any quadrilateral). What the
/// solver found of contact is not used.
std::vector<RelativeMotion> relative_motion(const ContactSide& slave, const std::vector<int>& nodes,
                                            const ContactSide& master, const SurfaceSearch& search);

}  // namespace railwave
