#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// A structured block of hexahedra: cells[0] x cells[1] x cells[2] of them, numbered fastest along the first direction.
struct Grid {
  std::array<int, 3> cells{1, 1, 1};
  bool closed = false;  ///< the first direction runs round: its last cells end on its first nodes, and it has no sides
  /// Names of the sides where the first, second, third direction begins and ends: node sets and surfaces.
  std::array<std::string, 3> first_side, last_side;
};

/// Where node (i, j, k) of a grid lies, m. The three directions must be right-handed there.
using GridPlacement = std::function<Vec3(int i, int j, int k)>;

Mesh grid_mesh(const Grid& grid, const GridPlacement& place);

/// Nodes along a line from `start` to `end` (m): cells of `size` from `zone_start` to `zone_end`, as far as those lie
/// on the line, and cells outwards from there that grow by at most `growth` up to `largest`. The zone's first node lies
/// at zone_start; where it would leave less than half a cell at an end it is moved there, and fitted if it fills the
/// line.
struct GradedLine {
  double start, end, zone_start, zone_end, size, growth, largest;
};
std::vector<double> nodes_of(const GradedLine& line);

/// The lines along the three directions of a graded grid.
using GridLines = std::array<GradedLine, 3>;
/// How many cells such a grid has.
double cells_of(const GridLines& lines);

/// Those faces of a side of the third direction whose cells have their middles in the zones of the lines along the
/// first two.
std::vector<Face> zone_faces(const std::vector<Face>& side, const GradedLine& first, const GradedLine& second);

}  // namespace railwave
