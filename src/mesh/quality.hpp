#pragma once

#include <string>

#include "mesh/mesh.hpp"

namespace railwave {

/// An extreme value of a mesh and the element that has it.
struct QualityExtreme {
  double value = 0;
  int element = -1;
  Vec3 centroid{0, 0, 0};
};

struct MeshQuality {
  int elements = 0;
  int nodes = 0;
  int inverted = 0;             ///< elements with a corner Jacobian or volume of 0 or less
  double volume = 0;            ///< m3
  QualityExtreme aspect_ratio;  ///< largest ratio of longest to shortest edge
  QualityExtreme
      jacobian_ratio;   ///< smallest ratio of least to greatest corner Jacobian (1: parallelepiped, < 0: inverted)
  QualityExtreme step;  ///< smallest V / (A_max C_d), s
};

/// Extremes over all elements; `dilatational_wave_speed` C_d (m/s) sets the stable step (thesis eq. 2.14).
MeshQuality mesh_quality(const Mesh& mesh, double dilatational_wave_speed);

/// Lines for `railwave check`, without a final newline.
std::string describe(const MeshQuality& quality);

}  // namespace railwave
