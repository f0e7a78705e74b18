#pragma once

#include <vector>

#include "case/scene.hpp"
#include "mesh/extrusion.hpp"
#include "mesh/grading.hpp"
#include "mesh/mesh.hpp"
#include "mesh/sections/section.hpp"

namespace railwave {

/// A wheel in hexahedra: its section turned about the axle, which lies along y through the origin; the tape circle is
/// in the plane y = 0, the flange towards -y. Angle 0 is the lowest point, arcs are positive towards +x. Node sets bore
/// and centre_section (the lower half's plane x = 0, when a layer lies there); surfaces tread (contact band over the
/// zone and a margin) and running_surface; element set zone. Its centre of mass lies on the axle (see
/// balance_wheel): nodes of the running surface are exact, nodes of the bore lie outside its circle by up to a^2 / 12
/// of its radius, where a is the angle of a cell. Throws InputError if the parameters don't fit.
Mesh wheel_mesh(const scene::MeshSource& source);

/// A wheel with what an axle needs to go on from its bore.
struct WheelBody {
  Extrusion extrusion;
  std::vector<int> bore_line;       ///< section nodes from low to high y
  std::vector<int> bore_stations;   ///< at which the bore has nodes
  std::vector<double> bore_angles;  ///< rad, of these
};

/// Throws InputError if the parameters don't fit.
/// @param source whose name and line complaints begin with; @param wheel its parameters
WheelBody wheel_body(const scene::MeshSource& source, const scene::WheelMesh& wheel);

/// Throws InputError if the parameters don't fit.
void check_wheel_mesh(const scene::MeshSource& source, const scene::WheelMesh& wheel);

/// About how many elements a wheel has, without making it. Throws InputError if the parameters don't fit.
double wheel_elements(const scene::MeshSource& source, const scene::WheelMesh& wheel);

/// Largest length, m, of its fine elements along the tread: those of the zone and, if it has one, of the path.
double wheel_fine_size(const scene::WheelMesh& wheel);

/// y of the tape circle of a wheelset's wheel at y > 0, m.
double tape_circle(const scene::WheelsetMesh& wheelset);

/// Layers round a wheel; those of the last level reach the bore.
Stations wheel_stations(const scene::WheelMesh& wheel);

/// Moves the nodes of an extruded wheel radially so that the mesh has its centre of mass on the axle and the volume of
/// its section turned about the axle, whatever the widths of its cells. The running surface stays exact, because all
/// nodes down to the first transition to coarser cells keep their places.
void balance_wheel(Extrusion& extrusion, const SectionMesh& section, const Stations& stations,
                   const scene::WheelMesh& wheel);

}  // namespace railwave
