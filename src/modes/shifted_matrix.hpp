#pragma once

#include <Eigen/SparseCholesky>

#include "modes/stiffness_matrix.hpp"

namespace railwave {

/// A - sigma I, factorised as L D L^T, A = M^(-1/2) K M^(-1/2): its negative pivots count the eigenvalues of K u = lambda M u
/// below sigma (Sylvester's law of inertia).
class ShiftedMatrix {
 public:
  /// @param mass of each unknown, above 0
  ShiftedMatrix(const StiffnessMatrix& stiffness, const Eigen::VectorXd& mass);

  int size() const { return size_; }

  /// y = A x, without the shift.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;
  /// All entries, for small models.
  Eigen::MatrixXd full() const;

  /// Makes ready for count_below() and solve(). Throws std::runtime_error where a pivot vanishes: the shift is an eigenvalue.
  void shift_to(double sigma);
  int count_below() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& x) const;

  long entries_of_factor() const { return entries_; }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  int size_, extra_;
  Matrix matrix_, shifted_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
  bool analysed_ = false;
  long entries_ = 0;
};

}  // namespace railwave
