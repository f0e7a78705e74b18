#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A wheel in hexahedra: its section turned about the axle, which lies along y through the origin; the tape circle is in
/// the plane y = 0, the flange towards -y. Angle 0 is the lowest point, arcs are positive towards +x.
/// Node sets bore and centre_section (the lower half's plane x = 0, when a layer lies there); surfaces tread (contact band
/// over the zone and a margin) and running_surface; element set zone. Throws InputError if the parameters don't fit.
Mesh wheel_mesh(const scene::MeshSource& source);

}  // namespace railwave
