#pragma once

#include "mesh/mesh.hpp"

namespace railwave {

/// Into how many bodies a mesh falls whose elements hold together by common faces: an edge or a node in common is a
/// hinge.
int connected_bodies(const Mesh& mesh);

}  // namespace railwave
