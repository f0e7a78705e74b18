#include "post/local_frame.hpp"

#include <cmath>

namespace railwave {
namespace {

constexpr double nearly_parallel = 1e-6;

Vector in_plane(const Vector& direction, const Vector& normal) { return direction - normal.dot(direction) * normal; }

}  // namespace

LocalFrame local_frame(const Vector& centre, const Vector& normal, const Vector& rolling) {
  LocalFrame frame;
  frame.centre = centre;
  frame.normal = normal.normalized();
  const Vector forward = rolling.normalized(), up = Vector::UnitZ();
  frame.along = in_plane(forward, frame.normal);
  if (frame.along.norm() < nearly_parallel)
    frame.along = in_plane(std::fabs(up.dot(frame.normal)) < 0.9 ? up : Vector(Vector::UnitX()), frame.normal);
  frame.along.normalize();
  frame.across = frame.normal.cross(frame.along);
  const double leftward = frame.across.dot(up.cross(forward));
  if (leftward < -nearly_parallel || (leftward < nearly_parallel && frame.across.dot(up) < 0))
    frame.across = -frame.across;
  return frame;
}

}  // namespace railwave
