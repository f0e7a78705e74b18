#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <stdexcept>
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

/// The factors of a matrix are of no use: a pivot vanishes, or what they solve stays wrong.
struct InaccurateFactor : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A = L D L^T of a sparse symmetric matrix, indefinite or not, without pivoting: multifrontal (Duff and Reid 1983),
/// dense blocks over the fronts of a nested dissection.
class FrontalFactor {
 public:
  /// Orders the unknowns; `lower` gives the pattern.
  FrontalFactor(const Eigen::SparseMatrix<double>& lower, const std::vector<std::array<double, 3>>& place);

  /// @param lower a matrix of that pattern; throws InaccurateFactor where a pivot vanishes
  void factorise(const Eigen::SparseMatrix<double>& lower);

  int negative_pivots() const { return negative_; }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  long entries() const { return entries_; }

 private:
  struct Columns {
    Eigen::MatrixXd lower;  ///< own columns of L, own rows first, unit diagonal not stored; then rows of the border
    Eigen::VectorXd pivots;
  };

  Dissection order_;
  std::vector<std::vector<int>> children_;
  std::vector<Columns> columns_;
  int negative_ = 0;
  long entries_ = 0;
};

}  // namespace railwave
