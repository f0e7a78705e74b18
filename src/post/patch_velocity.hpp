#pragma once

#include <vector>

#include "post/field_vectors.hpp"

namespace railwave {

/// Where a contact was at one instant.
struct PatchInstant {
  double time = 0;  ///< s
  bool touches = false;
  Vector centre = Vector::Zero();  ///< m, of the normal force
  double semi_axis = 0;            ///< m, longitudinal
};

/// Velocity of the contact over ground, m/s, at each instant: the slope of a straight line, by least squares, through
/// its centres at that and as many instants before and after as it takes to travel two semi-axes either way, of those
/// that the run has. The mesh shifts a centre by a fraction of a cell, which on this way is little. NaN where nothing
/// touches, and where the contact did not travel a semi-axis in all.
std::vector<Vector> patch_velocity(const std::vector<PatchInstant>& instants);

}  // namespace railwave
