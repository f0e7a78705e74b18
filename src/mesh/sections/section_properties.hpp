#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Area (m2), centroid (m) and second moments (m4) of plane faces, about the axes y and z through the centroid.
struct SectionProperties {
  double area = 0;
  double centroid_y = 0, centroid_z = 0;
  double moment_y = 0;                           ///< integral of (z - centroid_z)^2: vertical bending
  double moment_z = 0;                           ///< integral of (y - centroid_y)^2: lateral bending
  double product = 0;                            ///< integral of (y - centroid_y) (z - centroid_z)
  double greatest_moment = 0, least_moment = 0;  ///< principal values
};

/// Properties of faces that lie in a plane of constant x; each face counts as the polygon of its corners.
SectionProperties section_properties(const Mesh& mesh, const std::vector<Face>& faces);

}  // namespace railwave
