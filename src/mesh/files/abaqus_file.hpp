#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Reads the mesh of an Abaqus or CalculiX input file, in the file's own unit of length: *NODE; *ELEMENT of type C3D8,
/// C3D8R or C3D8I; *NSET, *ELSET (also GENERATE, and sets named in sets, before or after their definition); *SURFACE of
/// type ELEMENT (faces S1 to S6, or none for all outside faces of a set) and NODE (a node set); *INCLUDE; *PART,
/// *ASSEMBLY and one *INSTANCE with a translation.
///
/// Names are in lower case, as the format doesn't tell case. `exterior` and implied node sets: NumberedMesh::complete.
/// Keywords that don't describe the mesh (*MATERIAL, *STEP, ...) are passed over; `notes`, when given, lists them.
/// Throws InputError "file:line: what, how to mend".
Mesh read_abaqus_file(const std::string& path, std::vector<std::string>* notes = nullptr);

}  // namespace railwave
