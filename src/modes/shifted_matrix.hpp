#pragma once

#include <memory>

#include "modes/frontal_factor.hpp"
#include "modes/stiffness_matrix.hpp"

namespace railwave {

/// How well (A - sigma I) x = b was solved, over all solves: the relative residual is the largest |b - (A - sigma I)
/// x|_i over (|A - sigma I| |x| + |b|)_i of the rows i, the smallest relative change of entries with which x is exact
/// (Oettli and Prager 1964).
struct SolveQuality {
  double before = 0;    ///< largest relative residual of the factors alone
  double after = 0;     ///< the same after refinement
  int refinements = 0;  ///< most of one solve
};

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

  /// Makes ready for count_below() and solve(). Throws InaccurateFactor where a pivot vanishes: the shift is an
  /// eigenvalue of the matrix or of what is eliminated first.
  void shift_to(double sigma);
  int count_below() const;
  /// x of (A - sigma I) x = b. Factors without pivoting may be inaccurate, where a pivot is small: x is refined by its
  /// residual while that falls and is above 1e-12 (Arioli, Demmel and Duff 1989). Throws InaccurateFactor, with the
  /// frequency of sigma, where more than 1e-8 is left.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  const SolveQuality& quality() const { return quality_; }

  long entries_of_factor() const { return factor_->entries(); }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  Eigen::VectorXd refined(const Eigen::VectorXd& b) const;

  int size_, extra_;
  double sigma_ = 0;
  Matrix matrix_, shifted_;
  mutable SolveQuality quality_;
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
