#pragma once

#include "case/scene.hpp"
#include "mesh/extrusion.hpp"
#include "mesh/mesh.hpp"
#include "mesh/sections/rail_section.hpp"

namespace railwave {

/// A rail extruded along x, inclined about the x axis through the middle of its foot (y = 0, z = 0) towards -y, in
/// hexahedra graded from the solution zone on the running surface to the foot.
/// Node sets foot, start, end; surfaces head (contact band over zone and path and a margin), running_surface,
/// start_face, end_face, foot, fishing_left (towards -y) and fishing_right (head's underside, web and foot's upper
/// side); element set zone. Throws InputError if the parameters do not fit each other, for a height map that cannot be
/// read, and for one that inverts elements.
Mesh rail_mesh(const scene::MeshSource& source);

/// About how many elements it has, without making it. Throws InputError if the parameters do not fit each other.
double rail_elements(const scene::MeshSource& source);

/// Throws InputError with every parameter of a rail mesh that does not fit the others.
void check_rail_mesh(const scene::MeshSource& source);
/// The plan of its section.
RailSectionPlan section_plan(const scene::RailMesh& rail);
/// Its layers along x; the last of their levels has the foot's elements.
Stations rail_stations(const scene::RailMesh& rail);
/// Where a point of the upright section lies along x once the rail leans towards -y by `inclination`.
Placement inclined(double inclination);

}  // namespace railwave
