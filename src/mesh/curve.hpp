#pragma once

#include <cmath>
#include <functional>
#include <vector>

namespace railwave {

/// A point of a section: lateral and vertical (rail) or lateral and radial (wheel), m.
struct Point2 {
  double y = 0;
  double z = 0;
};

inline Point2 operator+(Point2 a, Point2 b) { return {a.y + b.y, a.z + b.z}; }
inline Point2 operator-(Point2 a, Point2 b) { return {a.y - b.y, a.z - b.z}; }
inline Point2 operator*(double s, Point2 a) { return {s * a.y, s * a.z}; }
inline double cross(Point2 a, Point2 b) { return a.y * b.z - a.z * b.y; }
inline double dot(Point2 a, Point2 b) { return a.y * b.y + a.z * b.z; }
double norm(Point2 a);

/// A plane curve given by its arc length, 0 to `length` (m). `at` may be called a little beyond both ends.
struct Curve {
  double length = 0;
  std::function<Point2(double)> at;

  Point2 begin() const { return at(0); }
  Point2 end() const { return at(length); }
  /// Unit normal on the left of the direction of travel.
  Point2 left_normal(double arc) const;
};

Curve line(Point2 from, Point2 to);

/// Circular arc shorter than a half circle. Positive radius: the centre lies on the left of the way from `from` to
/// `to`.
Curve arc(Point2 from, Point2 to, double radius);

/// The graph (s, height(s)) from s = `from` to `to` (either may be the larger), traversed by arc length.
Curve graph(double from, double to, std::function<double(double)> height, std::function<double(double)> slope);

Curve reversed(Curve curve);
/// Mirrored at y = 0.
Curve mirrored(Curve curve);
Curve part(Curve curve, double from, double to);
Curve joined(std::vector<Curve> curves);

/// Height of a circle's crest above its point at a horizontal distance from the crest, m; a radius of 0 means a
/// straight line.
inline double fall(double radius, double distance) {
  // R - sqrt(R^2 - d^2) without the difference of large numbers.
  return radius == 0 ? 0 : distance * distance / (radius + std::sqrt(radius * radius - distance * distance));
}

/// Height of the crest of a surface of revolution above its point at (x, y), m: an arc of radius `across` in the plane
/// of y and z, turned about an axis along y that lies `along` under the crest. Equal radii make a sphere, one of 0 a
/// cylinder.
inline double crown_fall(double along, double across, double x, double y) {
  const double side = fall(across, y);
  return side + (along == 0 ? 0 : fall(along - side, x));
}

}  // namespace railwave
