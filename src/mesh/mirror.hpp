#pragma once

#include "mesh/mesh.hpp"

namespace railwave {

/// Mirrors a mesh at the plane y = 0. Elements stay right-handed and faces look outwards: an element's first four
/// corners become its last. Sets keep their names.
void mirror(Mesh& mesh);

}  // namespace railwave
