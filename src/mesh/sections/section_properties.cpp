#include <cmath>

#include "mesh/sections/section.hpp"

namespace railwave {

SectionProperties section_properties(const Mesh& mesh, const std::vector<Face>& faces) {
  // Green's theorem, edge by edge. All faces run the same way round: counter-clockwise if the total area
  // is positive.
  double area = 0, first_y = 0, first_z = 0, yy = 0, zz = 0, yz = 0;
  for (const Face& face : faces) {
    const auto nodes = mesh.face_nodes(face);
    for (int i = 0; i < 4; ++i) {
      const Vec3 &a = mesh.nodes[nodes[i]], &b = mesh.nodes[nodes[(i + 1) % 4]];
      const double c = a[1] * b[2] - b[1] * a[2];
      area += c / 2;
      first_y += c * (a[1] + b[1]) / 6;
      first_z += c * (a[2] + b[2]) / 6;
      yy += c * (a[1] * a[1] + a[1] * b[1] + b[1] * b[1]) / 12;
      zz += c * (a[2] * a[2] + a[2] * b[2] + b[2] * b[2]) / 12;
      yz += c * (a[1] * b[2] + 2 * a[1] * a[2] + 2 * b[1] * b[2] + b[1] * a[2]) / 24;
    }
  }
  SectionProperties result;
  if (area == 0) return result;
  const double sign = area > 0 ? 1 : -1;
  result.area = sign * area;
  result.centroid_y = first_y / area;
  result.centroid_z = first_z / area;
  result.moment_y = sign * zz - result.area * result.centroid_z * result.centroid_z;
  result.moment_z = sign * yy - result.area * result.centroid_y * result.centroid_y;
  result.product = sign * yz - result.area * result.centroid_y * result.centroid_z;
  const double mean = (result.moment_y + result.moment_z) / 2;
  const double radius = std::hypot((result.moment_y - result.moment_z) / 2, result.product);
  result.greatest_moment = mean + radius;
  result.least_moment = mean - radius;
  return result;
}

}  // namespace railwave
