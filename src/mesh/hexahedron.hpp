#pragma once

#include <array>
#include <cmath>

#include "mesh/mesh.hpp"

/// Geometry of one trilinear hexahedron on the host.
namespace railwave {

using HexahedronCorners = std::array<Vec3, 8>;

inline HexahedronCorners corners_of(const std::vector<Vec3>& nodes, const CornerNodes& element) {
  HexahedronCorners corners;
  for (int N = 0; N < 8; ++N) corners[N] = nodes[element[N]];
  return corners;
}

/// Corner signs (xi, eta, zeta) of the element's corners.
inline constexpr int hexahedron_corner_signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// Neighbours of each corner along its three edges, which are right-handed in this order.
inline constexpr int hexahedron_corner_neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                                           {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};

/// Mean of the corners, m.
inline Vec3 hexahedron_centre(const HexahedronCorners& x) {
  Vec3 centre{0, 0, 0};
  for (const Vec3& corner : x)
    for (int i = 0; i < 3; ++i) centre[i] += corner[i] / 8;
  return centre;
}

/// Jacobian determinant of the trilinear map at (xi, eta, zeta) in [-1, 1]^3.
inline double hexahedron_jacobian(const HexahedronCorners& x, double xi, double eta, double zeta) {
  double J[3][3] = {};
  for (int N = 0; N < 8; ++N) {
    const auto& s = hexahedron_corner_signs[N];
    const double a = 1 + s[0] * xi, b = 1 + s[1] * eta, c = 1 + s[2] * zeta;
    for (int i = 0; i < 3; ++i) {
      J[0][i] += 0.125 * s[0] * b * c * x[N][i];
      J[1][i] += 0.125 * a * s[1] * c * x[N][i];
      J[2][i] += 0.125 * a * b * s[2] * x[N][i];
    }
  }
  return J[0][0] * (J[1][1] * J[2][2] - J[1][2] * J[2][1]) - J[0][1] * (J[1][0] * J[2][2] - J[1][2] * J[2][0]) +
         J[0][2] * (J[1][0] * J[2][1] - J[1][1] * J[2][0]);
}

/// Integral of each corner's shape function over the element, m3 (row-summed unit mass); two Gauss points a direction
/// integrate it exactly. Their sum is the exact volume.
inline std::array<double, 8> hexahedron_shape_integrals(const HexahedronCorners& x) {
  std::array<double, 8> integral{};
  const double g = 1.0 / std::sqrt(3.0);
  for (double xi : {-g, g})
    for (double eta : {-g, g})
      for (double zeta : {-g, g}) {
        const double jacobian = hexahedron_jacobian(x, xi, eta, zeta);
        for (int N = 0; N < 8; ++N) {
          const auto& s = hexahedron_corner_signs[N];
          integral[N] += 0.125 * (1 + s[0] * xi) * (1 + s[1] * eta) * (1 + s[2] * zeta) * jacobian;
        }
      }
  return integral;
}

inline double hexahedron_volume(const HexahedronCorners& x) {
  double volume = 0;
  for (double part : hexahedron_shape_integrals(x)) volume += part;
  return volume;
}

/// Area of a quadrilateral facet by one point, half the cross product of its diagonals (thesis eq. 2.18).
inline double facet_area(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double p[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, q[3] = {d[0] - b[0], d[1] - b[1], d[2] - b[2]};
  return 0.5 * std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
}

/// Characteristic length V / A_max of thesis eq. 2.14a, m.
inline double hexahedron_length(const HexahedronCorners& x) {
  double largest = 0;
  for (const auto& side : hexahedron_face_corners)
    largest = std::fmax(largest, facet_area(x[side[0]], x[side[1]], x[side[2]], x[side[3]]));
  return hexahedron_volume(x) / largest;
}

}  // namespace railwave
