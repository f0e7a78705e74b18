#include <cmath>

#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/contact/contact_state.hpp"

namespace railwave {

SurfaceGeometry surface_geometry(const std::vector<double>& position, const std::vector<std::array<int, 4>>& facets) {
  SurfaceGeometry geometry{std::vector<double>(position.size() / 3, 0), std::vector<double>(position.size(), 0)};
  const auto point = [&](int k) { return Vec3{position[3 * k], position[3 * k + 1], position[3 * k + 2]}; };
  for (const auto& facet : facets) {
    const Vec3 a = point(facet[0]), b = point(facet[1]), c = point(facet[2]), d = point(facet[3]);
    const double area = facet_area(a, b, c, d);
    const Vec3 normal = cross(difference(c, a), difference(d, b));
    for (int k : facet) {
      geometry.area[k] += 0.25 * area;
      for (int i = 0; i < 3; ++i) geometry.normal[3 * k + i] += normal[i];
    }
  }
  for (std::size_t k = 0; k < geometry.area.size(); ++k) {
    double* n = &geometry.normal[3 * k];
    const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; ++i) n[i] /= size;
  }
  return geometry;
}

}  // namespace railwave
