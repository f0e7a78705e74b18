#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A block whose top is curved: plane, cylinder, sphere, or an arc turned about an axis, exact at every node. Its crest
/// is above (0, 0), at the height of the top of the box between `origin` and `origin + size`. Cells have zone_size in
/// the zone under the top and grow away from it along x, y and downwards; the curve fades out towards the plane bottom.
/// Node sets and surfaces: top, bottom, x_min, x_max, y_min, y_max; surface zone, the top over the
/// solution zone: in a contact the small facets only, for large thin ones cost step. Throws InputError if the
/// parameters don't fit.
Mesh crowned_block_mesh(const scene::MeshSource& source);

}  // namespace railwave
