#pragma once

#include <vector>

#include "post/field_vectors.hpp"
#include "post/local_frame.hpp"

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

/// The part of each surface from which the rigid motion of its body is taken: all nodes whose distance from the patch's
/// centre is between these two, in larger semi-axes of the patch. Near the patch the surface strains as it passes (by
/// 1/distance squared); far off, the bodies bend and vibrate, and the surface ends.
struct CreepageRing {
  double inner = 1.5, outer = 3;
};

/// How two bodies would slip in a patch if they were rigid: the velocity of the slave less that of the master.
struct RigidSlip {
  RigidMotion slave, master;               ///< about the patch's centre
  bool known = false;                      ///< both were found
  double along = 0, across = 0;            ///< m/s, at the patch's centre
  double spin = 0;                         ///< rad/s, about along x across
  double mean_along = 0, mean_across = 0;  ///< m/s, mean velocity of the two bodies there
  /// What the choice of the ring does: largest distance of the same from its inner and its outer half alone. NaN if a
  /// half has too few nodes.
  double spread_along = 0, spread_across = 0, spread_spin = 0;
};

/// @param semi_axis the larger one of the patch, m
RigidSlip rigid_slip(const ContactState& state, const LocalFrame& frame, double semi_axis, const CreepageRing& ring);

}  // namespace railwave
