#pragma once

#include <vector>

#include "post/field_vectors.hpp"

namespace railwave {

/// The rigid motion that the nodes of a body share: v(x) = velocity + rotation x (x - about).
struct RigidMotion {
  int nodes = 0;                     ///< it was found from; 0: too few, or on one line
  Vector about = Vector::Zero();     ///< m
  Vector velocity = Vector::Zero();  ///< m/s, at `about`
  Vector rotation = Vector::Zero();  ///< rad/s
  double residual = 0;               ///< m/s, root of the mean square of what it leaves of the nodes' velocities
};

/// Least squares over the nodes listed, each counted by its area of the surface, so that it does not lean to where the
/// mesh is fine.
RigidMotion fit_rigid_motion(const ContactSide& side, const std::vector<int>& nodes, const Vector& about);

/// Nodes of a side at distances from `inner` to `outer`, m, from a point.
std::vector<int> nodes_in_ring(const ContactSide& side, const Vector& centre, double inner, double outer);

}  // namespace railwave
