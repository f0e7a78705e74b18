#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// Makes or reads the mesh that a case file's [meshes.NAME] describes. Throws InputError naming the entry and its line.
/// `notes`, when given, receives a line about each thing of a mesh file that was left out or renamed.
Mesh build_mesh(const scene::MeshSource& source, std::vector<std::string>* notes = nullptr);

}  // namespace railwave
