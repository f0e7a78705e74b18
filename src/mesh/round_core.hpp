#pragma once

#include <array>
#include <vector>

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

}  // namespace railwave
