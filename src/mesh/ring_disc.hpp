#pragma once

#include <array>
#include <vector>

#include "mesh/round_core.hpp"

namespace railwave {

/// A disc of radius 1 in quadrilaterals (an O-grid) on a rim whose nodes are given.
struct RingDisc {
  std::vector<RoundPoint> nodes;  ///< the rim's first
  std::vector<std::array<int, 4>>
      cells;    ///< counter-clockwise; the rim's first, with it between their first and second corner
  int rim = 0;  ///< nodes of the rim, and cells along it
};

/// @param angles of the rim's nodes, rad, rising by a turn in all; an even number of them, 8 or more. Rings of cells
/// lead to evenly spread angles inside, so that a crowd of nodes at one place of the rim does not make thin cells in
/// the middle.
RingDisc ring_disc(const std::vector<double>& angles);

}  // namespace railwave
