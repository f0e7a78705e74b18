#include "mesh/surface_above.hpp"

#include <cmath>
#include <limits>

#include "mesh/face_table.hpp"
#include "mesh/nearest_on_triangle.hpp"
#include "mesh/vectors.hpp"

namespace railwave {
namespace {

/// Of a triangle's area: what rounding may put a line beside it on whose edge it lies.
constexpr double on_the_edge = 1e-9;

/// Shares of the corners in the point of a triangle, seen from above, at (x, y); false: outside of it, or the triangle
/// stands upright.
bool shares_at(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y, double (&share)[3]) {
  const auto doubled = [](double ux, double uy, double vx, double vy) { return ux * vy - uy * vx; };
  const double area = doubled(b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
  const double size =
      std::fmax(std::fabs(b[0] - a[0]) + std::fabs(b[1] - a[1]), std::fabs(c[0] - a[0]) + std::fabs(c[1] - a[1]));
  if (!(area > 1e-9 * size * size)) return false;
  share[0] = doubled(b[0] - x, b[1] - y, c[0] - x, c[1] - y) / area;
  share[1] = doubled(c[0] - x, c[1] - y, a[0] - x, a[1] - y) / area;
  share[2] = doubled(a[0] - x, a[1] - y, b[0] - x, b[1] - y) / area;
  return share[0] >= -on_the_edge && share[1] >= -on_the_edge && share[2] >= -on_the_edge;
}

}  // namespace

SurfaceAbove::SurfaceAbove(const Mesh& mesh) : mesh_(mesh) {
  for (const Face& face : FaceTable(mesh).exterior()) {
    if (doubled_area(mesh.nodes, mesh.face_nodes(face))[2] > 0) faces_.push_back(face);
  }
}

std::optional<SurfaceAbove::Point> SurfaceAbove::over(double x, double y) const {
  std::optional<Point> top;
  for (const Face& face : faces_) {
    const auto corner = mesh_.face_nodes(face);
    for (int second : {1, 2}) {
      const Vec3 &a = mesh_.nodes[corner[0]], &b = mesh_.nodes[corner[second]], &c = mesh_.nodes[corner[second + 1]];
      double share[3];
      if (!shares_at(a, b, c, x, y, share)) continue;
      const double z = share[0] * a[2] + share[1] * b[2] + share[2] * c[2];
      if (top && z <= top->z) continue;
      // Sides of a hexahedron come in pairs: 0 and 1, 2 and 4, 3 and 5.
      constexpr int opposite[6] = {1, 0, 4, 5, 2, 3};
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (int n : corner) low = std::fmin(low, mesh_.nodes[n][1]), high = std::fmax(high, mesh_.nodes[n][1]);
      const auto beneath = mesh_.face_nodes({face.element, opposite[face.side]});
      const double height = length(difference(facet_centre(mesh_.nodes, corner), facet_centre(mesh_.nodes, beneath)));
      top = Point{z, height, high - low};
    }
  }
  return top;
}

Vec3 SurfaceAbove::nearest(const Vec3& place) const {
  Vec3 best = place;
  double least = std::numeric_limits<double>::infinity();
  for (const Face& face : faces_) {
    const auto corner = mesh_.face_nodes(face);
    for (int second : {1, 2}) {
      const Vec3 x = nearest_on_triangle(mesh_.nodes[corner[0]], mesh_.nodes[corner[second]],
                                         mesh_.nodes[corner[second + 1]], place);
      if (const double away = length(difference(x, place)); away < least) least = away, best = x;
    }
  }
  if (const auto top = over(best[0], best[1])) best[2] = top->z;
  return best;
}

}  // namespace railwave
