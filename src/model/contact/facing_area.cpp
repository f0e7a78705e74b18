#include "model/contact/facing_area.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {
namespace {

double along(const Vec3& axis, const Vec3& x) { return axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2]; }

/// Shape functions of a triangle at a point; false: it is outside, or the triangle is seen on edge.
bool inside(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& p,
            std::array<double, 3>& shape) {
  const auto twice_area = [](const PlanePoint& u, const PlanePoint& v, const PlanePoint& w) {
    return (v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0]);
  };
  const double whole = twice_area(a, b, c);
  const double size = std::fabs(b[0] - a[0]) + std::fabs(b[1] - a[1]) + std::fabs(c[0] - a[0]) + std::fabs(c[1] - a[1]);
  if (std::fabs(whole) < 1e-9 * size * size) return false;
  shape = {twice_area(p, b, c) / whole, twice_area(a, p, c) / whole, twice_area(a, b, p) / whole};
  return std::all_of(shape.begin(), shape.end(), [](double s) { return s > -1e-9; });
}

}  // namespace

ProjectedSurface::ProjectedSurface(const Assembly& assembly, const std::vector<Face>& faces,
                                   const std::array<Vec3, 3>& axes, const scene::Box* box) {
  for (const Face& face : faces) {
    Projected seen{assembly.face_nodes(face), {}, {1e300, 1e300}, {-1e300, -1e300}};
    Vec3 middle{0, 0, 0};
    for (int c = 0; c < 4; ++c) {
      const Vec3& x = assembly.nodes[seen.nodes[c]];
      for (int i = 0; i < 3; ++i) middle[i] += 0.25 * x[i];
      for (int i = 0; i < 2; ++i) {
        seen.corner[c][i] = along(axes[i], x);
        seen.low[i] = std::min(seen.low[i], seen.corner[c][i]);
        seen.high[i] = std::max(seen.high[i], seen.corner[c][i]);
      }
    }
    // Along the view only: faces that the area's edges cut count with what lies within.
    const double height = along(axes[2], middle);
    if (box) {
      const double first = along(axes[2], (*box)[0]), second = along(axes[2], (*box)[1]);
      if (height < std::min(first, second) || height > std::max(first, second)) continue;
    }
    for (int i = 0; i < 2; ++i) {
      low_[i] = std::min(low_[i], seen.low[i]);
      high_[i] = std::max(high_[i], seen.high[i]);
    }
    faces_.push_back(seen);
  }
}

bool ProjectedSurface::add_weights(PlanePoint point, double factor,
                                   std::vector<std::pair<int, double>>& weights) const {
  const double slack = 1e-9 * (high_[0] - low_[0] + high_[1] - low_[1]);
  for (const Projected& face : faces_) {
    if (point[0] < face.low[0] - slack || point[0] > face.high[0] + slack || point[1] < face.low[1] - slack ||
        point[1] > face.high[1] + slack)
      continue;
    // Both ways of cutting the face into triangles, half each, so that none of its corners is preferred.
    int found = 0;
    std::array<std::array<int, 3>, 2> corners{};
    std::array<std::array<double, 3>, 2> shapes{};
    for (int cut = 0; cut < 2; ++cut)
      for (int half = 0; half < 2; ++half) {
        const std::array<int, 3> corner{cut + 2 * half, (cut + 2 * half + 1) % 4, (cut + 2 * half + 2) % 4};
        if (found <= cut &&
            inside(face.corner[corner[0]], face.corner[corner[1]], face.corner[corner[2]], point, shapes[found]))
          corners[found++] = corner;
      }
    if (found == 0) continue;
    for (int k = 0; k < found; ++k)
      for (int c = 0; c < 3; ++c)
        if (shapes[k][c] != 0) weights.emplace_back(face.nodes[corners[k][c]], factor * shapes[k][c] / found);
    return true;
  }
  return false;
}

}  // namespace railwave
