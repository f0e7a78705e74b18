#pragma once

#include <string>
#include <vector>

#include "mesh/files/numbered_mesh.hpp"
#include "mesh/mesh.hpp"

/// Readers of mesh files, by format, and the names that their sets may have.
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

/// An Abaqus file's mesh as the file has it: no node is left out, and there are no sets but the file's own.
struct AbaqusNumbers {
  NumberedMesh numbered;
  Mesh mesh;  ///< its sets by the positions of `numbered`; internal sets too
};

/// The same as read_abaqus_file(), for what goes on with the file's numbers; elements' shapes are not checked.
AbaqusNumbers read_abaqus_numbers(const std::string& path);

/// Reads a Gmsh mesh file of version 4.1, ASCII or binary, in the file's own unit of length.
///
/// 8-node hexahedra become elements; other solid elements are refused. Physical groups give sets under their names, or
/// `physical_<tag>` when they have none: volumes an element set, surfaces (4-node quadrangles, each a face of a
/// hexahedron, turned outwards) a surface, curves and points a node set. A surface between two volumes belongs to the
/// element that it points out of. When groups of several dimensions share a name, its node set is that of the lowest.
/// `exterior` and implied node sets: NumberedMesh::complete. `notes`, when given, receives what was left out.
/// Throws InputError "file:line: what, how to mend" ("file: byte N: ..." inside binary data).
Mesh read_gmsh_file(const std::string& path, std::vector<std::string>* notes = nullptr);

/// A set's name in the form that a case and its results allow. Characters that separate paths, columns, channels or
/// attributes there ('/', '\\', ':', ',', ';', '*', '?', quotes, '<', '>', '&'), control characters and bytes that are
/// no UTF-8 are replaced by '_'; blanks at the ends are dropped, an empty name or one of dots alone becomes 'unnamed',
/// and the name is cut to 100 bytes.
std::string fit_set_name(const std::string& name);

/// Whether all of a text is UTF-8.
bool is_utf8(const std::string& text);

/// Renames all sets of a mesh read from a file by fit_set_name(); `notes`, when given, receives a line for each that
/// was changed. Throws InputError where two sets would have one name.
void fit_set_names(Mesh& mesh, const std::string& path, std::vector<std::string>* notes);

}  // namespace railwave
