#pragma once

#include "case/scene.hpp"

namespace railwave {

/// About how many elements the mesh of a case file's [meshes.NAME] will have, told from its parameters or the size of
/// its file in a fraction of the time that making it takes: at most a quarter too many for what is extruded, exact for
/// boxes and bars, within a factor of three for files and fishplates. Throws InputError, as build_mesh() would, when
/// the parameters do not fit each other or the mesh is too large.
double expected_elements(const scene::MeshSource& source);

/// m, the largest length of a mesh's fine elements: those of its solution zone and of the path that it has besides. 0
/// where it has neither.
double fine_element_size(const scene::MeshSource& source);

/// Throws InputError when the meshes and the model of all parts of a scene can't fit into the memory that is left; the
/// message names the part that takes the most of it.
void expect_room_for_parts(const scene::Scene& scene);

/// The same against a given number of bytes.
void expect_room_for_parts(const scene::Scene& scene, double available);

}  // namespace railwave
