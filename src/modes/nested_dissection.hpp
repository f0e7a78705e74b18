#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace railwave {

/// A front of a multifrontal factorisation: the unknowns that are eliminated together, and those later ones that they
/// touch.
struct Front {
  int parent = -1;          ///< -1: a root
  std::vector<int> own;     ///< in the new order one after the other: first new number ...
  int first = 0;            ///< ... this one
  std::vector<int> border;  ///< new numbers, ascending, of later fronts
};

/// Order of elimination of a sparse symmetric matrix whose unknowns have places: each set of unknowns is halved across
/// the direction in which fewest of them couple both halves; these come after both (George 1973).
struct Dissection {
  std::vector<Front> fronts;    ///< children before their parents
  std::vector<int> new_number;  ///< by old number
};

/// @param lower triangle of the matrix: its pattern
/// @param place by unknown; unknowns behind the last place have none and are eliminated last
Dissection nested_dissection(const Eigen::SparseMatrix<double>& lower, const std::vector<std::array<double, 3>>& place);

}  // namespace railwave
