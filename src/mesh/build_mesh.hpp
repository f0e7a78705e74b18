#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A line about each thing of a mesh file that was left out or renamed.
using MeshNotes = std::vector<std::string>;

/// How the meshes of one type are made. TYPE_generator() of each type in RAILWAVE_MESHES (case/scene_meshes.hpp) is
/// declared below and defined in a file of src/mesh; where one is missing, the program does not link.
struct MeshGenerator {
  /// Makes or reads the mesh. Throws InputError if the parameters don't fit. `notes` may be null.
  Mesh (*build)(const scene::MeshSource& source, MeshNotes* notes);
  /// About how many elements it will have, without making it. Where the parameters don't fit it throws InputError as
  /// `build` does, or returns any number.
  double (*elements)(const scene::MeshSource& source);
  /// m, the largest length of its fine elements: those of the solution zone and of the path. Null: it has neither.
  double (*fine_size)(const scene::MeshSource& source) = nullptr;
};

#define RAILWAVE_DECLARE(type, Parameters) MeshGenerator type##_generator();
RAILWAVE_MESHES(RAILWAVE_DECLARE)
#undef RAILWAVE_DECLARE

/// The generator of a mesh's type.
MeshGenerator generator_of(const scene::MeshSource& source);

/// Makes or reads the mesh that a case file's [meshes.NAME] describes. Throws InputError naming the entry and its line.
/// `notes`, when given, receives a line about each thing of a mesh file that was left out or renamed.
Mesh build_mesh(const scene::MeshSource& source, MeshNotes* notes = nullptr);

/// About how many elements the mesh of a case file's [meshes.NAME] will have, estimated from its parameters or the size
/// of its file in a fraction of the time that making it takes: at most a quarter too many for what is extruded, exact
/// for boxes and bars, within a factor of three for files and fishplates. Throws InputError, as build_mesh() would,
/// when the parameters do not fit each other or the mesh is too large.
double expected_elements(const scene::MeshSource& source);

/// m, the largest length of a mesh's fine elements: those of its solution zone and of the path that it has besides. 0
/// where it has neither.
double fine_element_size(const scene::MeshSource& source);

}  // namespace railwave
