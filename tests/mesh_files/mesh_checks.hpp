#pragma once

#include <string>
#include <vector>

#include "case/scene_meshes.hpp"
#include "mesh/mesh.hpp"
#include "source_folder.hpp"
#include "tests/mesh/topology.hpp"
#include "tests/temporary_folder.hpp"

// What the tests of mesh files share: a folder of their own, sources, and measures of a mesh that don't use the
// reader's code.
namespace railwave {

inline const std::string test_data = source_folder + "/tests/mesh_files/data/";

inline scene::MeshSource source_of_file(const std::string& path) {
  scene::MeshSource source;
  source.type = scene::MeshType::file;
  source.file.path = path;
  return source;
}

/// Volume enclosed by outward faces, by Gauss's theorem; exact for flat faces.
inline double enclosed_volume(const Mesh& mesh, const std::vector<Face>& surface) {
  double volume = 0;
  for (const Face& face : surface) {
    const Vec3& corner = mesh.nodes[mesh.face_nodes(face)[0]];
    const Vec3 area = area_vector(mesh, face);
    for (int i = 0; i < 3; ++i) volume += corner[i] * area[i] / 3;
  }
  return volume;
}

}  // namespace railwave
