#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A pad under a rail's foot from `start` to `end` along x: as wide as the foot's underside, leaning with it,
/// `thickness` thick everywhere. Its lines along and across the rail are those of the foot's elements, so that it can
/// be tied to the foot node on node and is nowhere the coarser mesh; `size` parts them further. Node sets and surfaces
/// x_min, x_max, y_min, y_max, z_min, z_max as a box has them. Throws InputError where it is no part of the rail's
/// length, and if the rail's parameters do not fit each other.
Mesh rail_pad_mesh(const scene::MeshSource& source);

}  // namespace railwave
