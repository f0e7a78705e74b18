#pragma once

#include <memory>

#include "modes/frontal_factor.hpp"
#include "modes/stiffness_matrix.hpp"

namespace railwave {

/// A - sigma I, factorised as L D L^T, A = M^(-1/2) K M^(-1/2): its negative pivots count the eigenvalues of K u =
/// lambda M u below sigma (Sylvester's law of inertia).
class ShiftedMatrix {
 public:
  /// @param mass of each unknown, above 0
  /// @param place of each unknown, m, for the order of elimination
  ShiftedMatrix(const StiffnessMatrix& stiffness, const Eigen::VectorXd& mass, const std::vector<Vec3>& place);

  int size() const { return size_; }

  /// y = A x, without the shift.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;
  /// All entries, for small models.
  Eigen::MatrixXd full() const;

  /// Makes ready for count_below() and solve(). Throws std::runtime_error where a pivot vanishes: the shift is an
  /// eigenvalue.
  void shift_to(double sigma);
  int count_below() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& x) const;

  long entries_of_factor() const { return factor_->entries(); }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  int size_, extra_;
  Matrix matrix_, shifted_;
  std::unique_ptr<FrontalFactor> factor_;
};

/// Eigenvalues, ascending, and orthonormal eigenvectors (columns).
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// All eigenpairs below a limit, as many as the inertia of A - limit I counts: Lanczos' method (Spectra) on (A - sigma
/// I)^-1 for intervals of the spectrum, sigma the middle of each; what an interval still lacks (copies of multiple
/// eigenvalues) is sought again across what has been found.
/// @param most eigenvalues of one interval
/// Throws std::runtime_error when not all of them come.
Eigenpairs eigenpairs_below(ShiftedMatrix& matrix, double limit, int most = 80);

}  // namespace railwave
