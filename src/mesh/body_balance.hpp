#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// How a body of revolution about the axis y may be moved, by node: its distance r from the axis grows by
/// share (A shape + B x / r + C z / r), a fraction of it.
struct RadialMotion {
  std::vector<double> share, shape;
};

/// Moves nodes so that the mesh has a volume (m3) and its centre of mass on the axis; finds A, B and C for that. Leaves
/// the mesh as it is if a node would have to move by a tenth of its distance or more: its cells are too wide.
void balance_body(Mesh& mesh, const RadialMotion& motion, double volume);

double mesh_volume(const Mesh& mesh);

}  // namespace railwave
