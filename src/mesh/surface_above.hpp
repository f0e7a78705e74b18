#pragma once

#include <optional>

#include "mesh/mesh.hpp"

namespace railwave {

/// A mesh's upper surface: the highest of its outside on each vertical line.
class SurfaceAbove {
 public:
  struct Point {
    double z = 0;               ///< m
    double element_height = 0;  ///< m, of the element under it, from its face there to the opposite one
    double element_width = 0;   ///< m, of that face along y
  };

  explicit SurfaceAbove(const Mesh& mesh);

  /// The surface on the vertical line through (x, y); none: the line misses the mesh.
  std::optional<Point> over(double x, double y) const;

  /// The place on the surface nearest to another place, m; where the nearest face is covered by others, the place above
  /// it.
  Vec3 nearest(const Vec3& place) const;

 private:
  const Mesh& mesh_;
  std::vector<Face> faces_;  ///< on the outside, looking up
};

}  // namespace railwave
