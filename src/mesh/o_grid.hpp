#pragma once

#include <array>
#include <vector>

/// Round sections in quadrilaterals: a core, and rings of cells about it (O-grids).
namespace railwave {

/// A point of a round section, m.
using RoundPoint = std::array<double, 2>;

/// Point of a disc that lies in the direction of (u, v), a point of the square from -1 to 1, equal angles for equal
/// ways along the square's sides.
RoundPoint on_disc(double u, double v, double radius);

/// Place of (u, v) in the core of an O-grid, a square with its corners on the circle of that radius, its sides bulged
/// the more the farther out they are.
RoundPoint in_round_core(double u, double v, double radius);

/// Columns and rows of the nodes on the outline of `along` x `up` cells, counter-clockwise from (0, 0).
std::vector<std::array<int, 2>> core_outline(int along, int up);

/// A disc of radius 1 in quadrilaterals (an O-grid) on a rim whose nodes are given.
struct RingDisc {
  std::vector<RoundPoint> nodes;  ///< the rim's first
  std::vector<std::array<int, 4>>
      cells;    ///< counter-clockwise; the rim's first, with it between their first and second corner
  int rim = 0;  ///< nodes of the rim, and cells along it
};

/// Rings of cells lead to evenly spread angles inside, so that a crowd of nodes at one place of the rim does not make
/// thin cells in the middle.
/// @param angles of the rim's nodes, rad, rising by a turn in all; an even number of them, 8 or more
/// @param radii of the rim's nodes, about 1
RingDisc ring_disc(const std::vector<double>& angles, const std::vector<double>& radii);

}  // namespace railwave
