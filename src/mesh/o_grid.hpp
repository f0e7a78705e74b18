#pragma once

#include <array>
#include <vector>

/// Round sections in quadrilaterals: a core, and rings of cells about it (O-grids).
namespace railwave {

/// A point of a round section, m.
using RoundPoint = std::array<double, 2>;

/// Maps the square from -1 to 1 onto a disc: squares about the centre become circles, and equal steps along their sides
/// become equal angles.
RoundPoint on_disc(double u, double v, double radius);

/// Maps the square from -1 to 1 onto the core of an O-grid: its corners lie on the circle of that radius, and its sides
/// are curved outwards, more at the outline than near the centre.
RoundPoint in_round_core(double u, double v, double radius);

/// Columns and rows of the nodes on the outline of `along` x `up` cells, counter-clockwise from (0, 0).
std::vector<std::array<int, 2>> core_outline(int along, int up);

/// A disc of radius 1 in quadrilaterals (an O-grid) on a rim whose nodes are given.
struct RingDisc {
  std::vector<RoundPoint> nodes;  ///< the rim's first
  /// Corners counter-clockwise. Cells at the rim come first; their first two corners lie on it.
  std::vector<std::array<int, 4>> cells;
  int rim = 0;  ///< number of nodes on the rim, and of cells along it
};

/// From ring to ring inwards the nodes approach equal angles, so that closely spaced nodes on a part of the rim do not
/// make thin cells in the middle.
/// @param angles of the rim's nodes, rad, ascending over less than a full turn; an even number of them, 8 or more
/// @param radii of the rim's nodes, about 1
RingDisc ring_disc(const std::vector<double>& angles, const std::vector<double>& radii);

}  // namespace railwave
