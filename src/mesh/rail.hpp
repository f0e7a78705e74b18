#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A rail extruded along x, inclined about the x axis through the middle of its foot (y = 0, z = 0) towards -y, in
/// hexahedra graded from the solution zone on the running surface to the foot.
/// Node sets foot, start, end; surfaces head (contact band over the zone and a margin), running_surface, start_face,
/// end_face, foot; element set zone. Throws InputError if the parameters do not fit each other, for a height map that cannot be
/// read, and for one that inverts elements.
Mesh rail_mesh(const scene::MeshSource& source);

}  // namespace railwave
