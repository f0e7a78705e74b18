#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "kernels/materials/plastic_flow.hpp"

namespace railwave {

/// Mixed hardening at finite strain in extended precision, by spectral decompositions: exact logarithm of the trial
/// b_e, return along s - b, exponential back. Keeps the inverse plastic metric, and the back stress in axes turned back
/// by the rotation of F. Shares nothing with the kernel but the constants.
struct ExactKinematic {
  using Real = long double;
  using Tensor = Eigen::Matrix<Real, 3, 3>;
  using Vector = Eigen::Matrix<Real, 3, 1>;

  BilinearConstants constants;
  Real beta;
  Tensor inverse_metric = Tensor::Identity();  ///< (F_p^T F_p)^-1
  Tensor back = Tensor::Zero();
  Real equivalent = 0, work = 0;

  template <class Function>
  static Tensor of_principal(const Tensor& symmetric, const Function& function) {
    const Eigen::SelfAdjointEigenSolver<Tensor> spectrum(symmetric);
    Vector values;
    for (int i = 0; i < 3; ++i) values[i] = function(spectrum.eigenvalues()[i]);
    return spectrum.eigenvectors() * values.asDiagonal() * spectrum.eigenvectors().transpose();
  }

  static Real mises(const Tensor& deviator) { return std::sqrt(Real(1.5)) * deviator.norm(); }

  /// Kirchhoff stress. @param H displacement gradient along present coordinates, F = (I - H)^-1
  Eigen::Matrix3d stress(const Eigen::Matrix3d& H) {
    const Real mu = constants.elastic.mu, lambda = constants.elastic.lambda, hardening = constants.hardening;
    const Tensor F = (Tensor::Identity() - H.cast<Real>()).inverse();
    Tensor h = of_principal(F * inverse_metric * F.transpose(), [](Real b) { return std::log(b) / 2; });
    const Tensor R = F * of_principal(F.transpose() * F, [](Real square) { return 1 / std::sqrt(square); });
    const Tensor mean = Tensor::Identity() * (h.trace() / 3), b = R * back * R.transpose();
    const Tensor xi = 2 * mu * (h - mean) - b;
    const Real limit = constants.yield_stress + beta * hardening * equivalent;
    if (mises(xi) > limit) {
      const Real increment = (mises(xi) - limit) / (3 * mu + hardening);
      const Tensor flow = Real(1.5) * increment / mises(xi) * xi;
      const Tensor moved = b + Real(2) / 3 * (1 - beta) * hardening * flow;
      work += (limit + beta * hardening * increment / 2) * increment + (b + moved).cwiseProduct(flow).sum() / 2;
      h -= flow;
      equivalent += increment;
      back = R.transpose() * moved * R;
      inverse_metric = F.inverse() * of_principal(h, [](Real e) { return std::exp(2 * e); }) * F.inverse().transpose();
    }
    return (lambda * h.trace() * Tensor::Identity() + 2 * mu * h).cast<double>();
  }
};

}  // namespace railwave
