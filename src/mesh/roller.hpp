#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A roller, a whole ring or a sector of one, exact at every node of its tread, which may be crowned. The axle lies
/// along y through the origin; arcs are measured at the tread from the lowest point, positive towards +x. Cells have
/// zone_size in the zone under the tread and grow away from it round the roller, along the axle and inwards. Node sets
/// and surfaces: tread, bore, y_min, y_max; of a sector also arc_min, arc_max; surface zone, the tread over the
/// solution zone: in a contact the small facets only, for large thin ones cost step. Throws InputError if the
/// parameters don't fit.
Mesh roller_mesh(const scene::MeshSource& source);

}  // namespace railwave
