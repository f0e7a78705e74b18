#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Radii of nodes at unequal angles round a circle of radius 1, such that the polygon through them has its centroid at
/// the circle's centre and the circle's area, up to terms of order a^4 in the angle a between two nodes. If the nodes
/// were on the circle, each chord would cut the fraction a^2 / 6 off its sector: a solid disc would be heavier where
/// its cells are narrow, a body with a round hole heavier where they are wide. Radii of about 1 + a^2 / 12 compensate
/// for that. All radii are 1 if an angle exceeds 1 rad, because such a polygon is no approximation of a circle.
/// @param angles rad, ascending over less than a full turn
std::vector<double> balanced_radii(const std::vector<double>& angles);

/// Radial motion of the nodes of a body of revolution about the axis y, with three amplitudes A, B and C: the distance
/// r of node n from the axis is multiplied by 1 + share[n] (A shape[n] + B x / r + C z / r).
struct RadialMotion {
  std::vector<double> share, shape;
};

/// Moves nodes so that the mesh has the given volume (m3) and its centre of mass on the axis: solves for A, B and C.
/// Leaves the mesh as it is if a node would have to move by a tenth of its distance from the axis or more, because then
/// the cells are too wide to be balanced.
void balance_body(Mesh& mesh, const RadialMotion& motion, double volume);

/// Sum of the elements' volumes, m3.
double mesh_volume(const Mesh& mesh);

}  // namespace railwave
