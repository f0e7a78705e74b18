#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Heights measured on a grid of places: how far a surface is above the nominal one, m.
class HeightMap {
 public:
  /// Reads a CSV file whose first line names the columns x, y, dz (m) and which has one line for each pair of its x and
  /// y, in any order; case/number_table.hpp says how numbers and columns may be written. Throws InputError naming file
  /// and line for other columns, numbers that are none, places given twice, and places that are missing.
  explicit HeightMap(const std::string& path);

  /// By bilinear interpolation, m; 0 beyond the grid.
  double at(double x, double y) const;

 private:
  std::vector<double> x_, y_;   ///< ascending
  std::vector<double> height_;  ///< by x, then y
};

/// Moves the nodes of a surface that looks up (+z), and those below it, by the map's heights along z: all of the height
/// at the surface, less the deeper, nothing from `depth` (m) down, with a cubic in between that has no slope at either
/// end. Throws InputError with `place` before it where this inverts an element.
void apply_height_map(const HeightMap& map, double depth, const std::vector<Face>& surface, const std::string& place,
                      Mesh& mesh);

}  // namespace railwave
