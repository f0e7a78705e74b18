#pragma once

#include "modes/nested_dissection.hpp"

namespace railwave {

/// A = L D L^T of a sparse symmetric matrix, indefinite or not, without pivoting: multifrontal (Duff and Reid 1983),
/// dense blocks over the fronts of a nested dissection.
class FrontalFactor {
 public:
  /// Orders the unknowns; `lower` gives the pattern.
  FrontalFactor(const Eigen::SparseMatrix<double>& lower, const std::vector<std::array<double, 3>>& place);

  /// @param lower a matrix of that pattern; throws std::runtime_error where a pivot vanishes
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
