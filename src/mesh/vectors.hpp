#pragma once

#include <cmath>

#include "mesh/mesh.hpp"

/// Vectors on the host. Include it in .cpp files only: tests define the same operations as operators.
namespace railwave {

inline Vec3 difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 sum(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 scaled(double factor, const Vec3& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Mean of a facet's corners, m.
inline Vec3 facet_centre(const std::vector<Vec3>& nodes, const std::array<int, 4>& corners) {
  Vec3 centre{0, 0, 0};
  for (int n : corners)
    for (int i = 0; i < 3; ++i) centre[i] += nodes[n][i] / 4;
  return centre;
}

/// Normal of a facet, twice its area long, m2: the cross product of its diagonals.
/// @param corners of it, counter-clockwise seen from outside
inline Vec3 doubled_area(const std::vector<Vec3>& nodes, const std::array<int, 4>& corners) {
  return cross(difference(nodes[corners[2]], nodes[corners[0]]), difference(nodes[corners[3]], nodes[corners[1]]));
}

}  // namespace railwave
