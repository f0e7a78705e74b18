#pragma once

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include "mesh/mesh.hpp"
#include "source_folder.hpp"
#include "tests/temporary_folder.hpp"

// What the tests of mesh files share: a folder of their own, and measures of a mesh that don't use the reader's code.
namespace railwave {

inline const std::string test_data = source_folder + "/tests/mesh_files/data/";

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("can't read " + path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vec3 difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Area times outward normal of a surface.
inline Vec3 area_vector(const Mesh& mesh, const std::vector<Face>& surface) {
  Vec3 total{0, 0, 0};
  for (const Face& face : surface) {
    const auto n = mesh.face_nodes(face);
    const Vec3 twice =
        cross(difference(mesh.nodes[n[2]], mesh.nodes[n[0]]), difference(mesh.nodes[n[3]], mesh.nodes[n[1]]));
    for (int i = 0; i < 3; ++i) total[i] += twice[i] / 2;
  }
  return total;
}

/// Volume enclosed by outward faces, by Gauss's theorem; exact for flat faces.
inline double enclosed_volume(const Mesh& mesh, const std::vector<Face>& surface) {
  double volume = 0;
  for (const Face& face : surface) {
    const Vec3& corner = mesh.nodes[mesh.face_nodes(face)[0]];
    const Vec3 area = area_vector(mesh, {face});
    for (int i = 0; i < 3; ++i) volume += corner[i] * area[i] / 3;
  }
  return volume;
}

}  // namespace railwave
