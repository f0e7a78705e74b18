#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Radii of nodes at unequal angles round a circle of radius 1, by which a polygon has the circle's area and centre.
/// The chord of an angle a cuts a^2 / 6 off its sector, so that a solid disc of wide and narrow cells is heavier at the
/// narrow ones, and what surrounds a hole heavier at the wide. Radii of about 1 + a^2 / 12 mend that: triangles on
/// chords have nearly the area of their sectors, and first moments with it to the fourth power of a. A node between two
/// chords takes half of what each of them lacks. All are 1 if an angle is wider than 1 rad: that is no circle.
/// @param angles rad, rising by less than a turn in all
std::vector<double> balanced_radii(const std::vector<double>& angles);

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
