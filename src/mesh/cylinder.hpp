#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A solid round bar along z from z = 0, its axis through the origin: a square-like core of core_divisions x
/// core_divisions columns of elements, its sides bulged, within four blocks of ring_divisions that reach the skin (an
/// O-grid); exact at every node of the skin. Layers along z grow by a constant factor, so that the last is end_ratio
/// times the first. Node sets and surfaces: skin, z_min, z_max. Throws InputError if the parameters don't fit.
Mesh cylinder_mesh(const scene::MeshSource& source);

}  // namespace railwave
