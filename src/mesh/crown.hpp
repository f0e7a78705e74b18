#pragma once

#include <cmath>

namespace railwave {

/// By how much a circle of the given radius has fallen at a distance from its crest, m; a radius of 0 means a straight
/// line.
inline double fall(double radius, double distance) {
  // R - sqrt(R^2 - d^2) without the difference of large numbers.
  return radius == 0 ? 0 : distance * distance / (radius + std::sqrt(radius * radius - distance * distance));
}

/// By how much a surface of revolution has fallen at (x, y) from its crest, m: an arc of radius `across` in the plane
/// of y and z, turned about an axis along y that lies `along` under the crest. Equal radii make a sphere, one of 0 a
/// cylinder.
inline double crown_fall(double along, double across, double x, double y) {
  const double side = fall(across, y);
  return side + (along == 0 ? 0 : fall(along - side, x));
}

}  // namespace railwave
