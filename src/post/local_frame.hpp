#pragma once

#include "post/field_vectors.hpp"

namespace railwave {

/// Axes of a contact patch, thesis 3.4.1: all unit vectors.
struct LocalFrame {
  Vector centre = Vector::Zero();
  Vector normal = Vector::UnitZ();  ///< of the patch's normal force on the slave
  Vector along = Vector::UnitX();   ///< longitudinal: the rolling direction turned into the tangent plane
  Vector across = Vector::UnitY();  ///< lateral: square to both others, and to the left of the rolling direction or up

  /// Of a point: its place about the centre, m; of a direction: its components. In the order along, across, normal.
  Vector place(const Vector& point) const { return components(point - centre); }
  Vector components(const Vector& direction) const {
    return {direction.dot(along), direction.dot(across), direction.dot(normal)};
  }
};

/// Axes from the direction of the normal force and the rolling direction; neither need have unit length. "Left" is that
/// of someone who looks along the rolling direction with z up. Where the normal is the rolling direction itself (a
/// head-on impact) the longitudinal axis is the z axis turned into the tangent plane.
LocalFrame local_frame(const Vector& centre, const Vector& normal, const Vector& rolling);

}  // namespace railwave
