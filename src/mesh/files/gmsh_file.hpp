#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Reads a Gmsh mesh file of version 4.1, ASCII or binary, in the file's own unit of length.
///
/// 8-node hexahedra become elements; other solid elements are refused. Physical groups give sets under their names, or
/// `physical_<tag>` when they have none: volumes an element set, surfaces (4-node quadrangles, each a face of a
/// hexahedron, turned outwards) a surface, curves and points a node set. A surface between two volumes belongs to the
/// element that it points out of. When groups of several dimensions share a name, its node set is that of the lowest.
/// `exterior` and implied node sets: NumberedMesh::complete. `notes`, when given, receives what was left out.
/// Throws InputError "file:line: what, how to mend" ("file: byte N: ..." inside binary data).
Mesh read_gmsh_file(const std::string& path, std::vector<std::string>* notes = nullptr);

}  // namespace railwave
