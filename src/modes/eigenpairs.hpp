#pragma once

#include "modes/shifted_matrix.hpp"

namespace railwave {

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
