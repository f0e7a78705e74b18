#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// Makes or reads the mesh that a case file's [meshes.NAME] describes. Throws InputError naming the entry and its line.
Mesh build_mesh(const scene::MeshSource& source);

}  // namespace railwave
