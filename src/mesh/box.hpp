#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// Makes a rectangular block of `box.divisions[0..2]` equal hexahedra along x, y, z between `box.origin` and
/// `box.origin + box.size` (m). Node and element numbers run fastest along x, then y, then z.
/// Node sets and surfaces x_min, x_max, y_min, y_max, z_min, z_max are its six sides.
/// Throws InputError when a size or division isn't positive, or the block has more nodes than an int counts.
Mesh box_mesh(const scene::MeshSource& source);

}  // namespace railwave
