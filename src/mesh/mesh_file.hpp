#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// Reads the mesh file `source.file.path`, by its ending: .inp (Abaqus, CalculiX) or .msh (Gmsh MSH 4.1), and
/// multiplies the coordinates by `source.file.scale`. `notes`, when given, receives one line about each thing that was
/// left out. Throws InputError naming the entry of the case file, or file and line (byte, in a binary file) of the mesh
/// file.
Mesh read_mesh_file(const scene::MeshSource& source, std::vector<std::string>* notes = nullptr);

}  // namespace railwave
