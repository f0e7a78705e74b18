#pragma once

#include "kernels/elements/element_modes.hpp"
#include "kernels/materials/elastic.hpp"
#include "kernels/nodes/nodes.hpp"

namespace railwave {

/// Eigenvalues of a symmetric 3 x 3 matrix on its diagonal, eigenvectors as columns of Q: Jacobi's method (Golub and
/// Van Loan 2013, 8.5), sweep by sweep in fixed order.
KOKKOS_INLINE_FUNCTION void diagonalize(double (&A)[3][3], double (&Q)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Q[i][j] = i == j ? 1 : 0;
  for (int sweep = 0; sweep < 12; ++sweep) {
    if (A[0][1] == 0 && A[1][2] == 0 && A[0][2] == 0) return;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (A[p][q] == 0) continue;
        const double theta = 0.5 * (A[q][q] - A[p][p]) / A[p][q];
        // Beyond 1e150 its square would overflow, and the turn is theta's inverse.
        const double t = std::fabs(theta) > 1e150
                             ? 0.5 / theta
                             : (theta < 0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(1 + theta * theta));
        const double c = 1 / std::sqrt(1 + t * t), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = A[k][p], kq = A[k][q];
          A[k][p] = c * kp - s * kq;
          A[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = A[p][k], qk = A[q][k];
          A[p][k] = c * pk - s * qk;
          A[q][k] = s * pk + c * qk;
        }
        A[p][q] = A[q][p] = 0;
        for (int k = 0; k < 3; ++k) {
          const double kp = Q[k][p], kq = Q[k][q];
          Q[k][p] = c * kp - s * kq;
          Q[k][q] = s * kp + c * kq;
        }
      }
  }
}

/// Logarithmic strain ln V of the present configuration, global axes, from the Almansi strain e = (I - F^-T F^-1)/2:
/// ln V = -1/2 ln(I - 2 e), by eigenvalues, whatever the size of the strain (hencky_strain() is the series that the
/// stress goes by).
/// @param e xx, yy, zz, xy, yz, zx (tensor components)
/// @param h result, likewise
KOKKOS_INLINE_FUNCTION void logarithmic_strain(const double (&e)[6], double (&h)[6]) {
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  double A[3][3], Q[3][3];
  for (int c = 0; c < 6; ++c) A[row[c]][column[c]] = A[column[c]][row[c]] = e[c];
  diagonalize(A, Q);
  for (int c = 0; c < 6; ++c) {
    h[c] = 0;
    for (int k = 0; k < 3; ++k) h[c] += Q[row[c]][k] * Q[column[c]][k] * (-0.5 * std::log1p(-2 * A[k][k]));
  }
}

/// Logarithmic strain of single elements, from their mean deformation gradient, in double precision.
struct ListedStrain {
  NodeArrays nodes;
  Array<const int* [8]> corner;  ///< model node numbers, by listed element
  Array<double* [6]> strain;     ///< result

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    double x[3][7], u[3][7], B[3][6], H[3][3], e[6], h[6];
    for (int d = 0; d < 3; ++d) {
      double now[8], moved[8];
      for (int k = 0; k < 8; ++k) {
        const int n = corner(i, k);
        now[k] = nodes.position(n, d) - nodes.position(corner(i, 0), d);
        moved[k] = nodes.position(n, d) - nodes.reference(n, d);
      }
      modes_of(now, x[d]);
      modes_of(moved, u[d]);
    }
    mean_gradient<double>(x, B);
    const double volume = along(x[0], B[0]);
    for (int d = 0; d < 3; ++d)
      for (int j = 0; j < 3; ++j) H[d][j] = along(u[d], B[j]) / volume;
    almansi_strain<double>(H, e);
    logarithmic_strain(e, h);
    for (int c = 0; c < 6; ++c) strain(i, c) = h[c];
  }
};

}  // namespace railwave
