#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "kernels/materials/plastic_flow.hpp"

/// Two references that share nothing with the kernel but the constants.
namespace railwave {

using Matrix = Eigen::Matrix3d;

/// Finite strain, by spectral decomposition: exact logarithms of the trial b_e, return in principal stresses,
/// exponentials back; keeps the inverse plastic metric.
struct SpectralPlasticity {
  BilinearConstants constants;
  Matrix inverse_metric = Matrix::Identity();  ///< (F_p^T F_p)^-1
  double equivalent = 0, work = 0;

  Matrix stress(const Matrix& F) {
    const double mu = constants.elastic.mu, lambda = constants.elastic.lambda;
    const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(F * inverse_metric * F.transpose());
    const Eigen::Vector3d h = 0.5 * spectrum.eigenvalues().array().log();
    const Eigen::Vector3d mean = Eigen::Vector3d::Constant(h.sum() / 3);
    Eigen::Vector3d s = 2 * mu * (h - mean);
    const double mises = std::sqrt(1.5) * s.norm(), limit = constants.yield_stress + constants.hardening * equivalent;
    if (mises > limit) {
      const double increment = (mises - limit) / (3 * mu + constants.hardening);
      s *= 1 - 3 * mu * increment / mises;
      equivalent += increment;
      work += (limit + 0.5 * constants.hardening * increment) * increment;
      const Eigen::Vector3d stretch_square = (2 * (s / (2 * mu) + mean)).array().exp();
      const Matrix b = spectrum.eigenvectors() * stretch_square.asDiagonal() * spectrum.eigenvectors().transpose();
      inverse_metric = F.inverse() * b * F.inverse().transpose();
    }
    const Eigen::Vector3d tau = s + (lambda + 2 * mu / 3) * 3 * mean;
    return spectrum.eigenvectors() * tau.asDiagonal() * spectrum.eigenvectors().transpose();
  }
};

/// Small strain, rate equations of flow with linear hardening integrated by Runge-Kutta's fourth order between two
/// strains along a straight line. `stress` is the deviator.
struct RatePlasticity {
  BilinearConstants constants;
  Matrix stress = Matrix::Zero();
  double equivalent = 0;

  void go(const Matrix& strain_increment, int steps) {
    const Matrix de = (strain_increment - Matrix::Identity() * strain_increment.trace() / 3) / steps;
    for (int k = 0; k < steps; ++k) {
      double share = elastic_share(de);
      stress += share * 2 * constants.elastic.mu * de;
      if (share < 1) flow((1 - share) * de);
    }
  }

 private:
  double mises(const Matrix& s) const { return std::sqrt(1.5) * s.norm(); }

  /// Part of an increment after which the yield surface is reached, by bisection.
  double elastic_share(const Matrix& de) const {
    const double limit = constants.yield_stress + constants.hardening * equivalent;
    const auto beyond = [&](double share) { return mises(stress + share * 2 * constants.elastic.mu * de) > limit; };
    if (!beyond(1)) return 1;
    double low = 0, high = 1;
    if (mises(stress) > limit * (1 - 1e-9) && (stress.cwiseProduct(de)).sum() > 0) return 0;
    for (int k = 0; k < 60; ++k) (beyond(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    return low;
  }

  void flow(const Matrix& de) {
    const double mu = constants.elastic.mu;
    const auto rate = [&](const Matrix& s, double& equivalent_rate) {
      const Matrix n = s / s.norm();
      equivalent_rate = std::sqrt(1.5) * 2 * mu * n.cwiseProduct(de).sum() / (3 * mu + constants.hardening);
      return Matrix(2 * mu * (de - std::sqrt(1.5) * equivalent_rate * n));
    };
    double a[4];
    const Matrix k1 = rate(stress, a[0]), k2 = rate(stress + 0.5 * k1, a[1]), k3 = rate(stress + 0.5 * k2, a[2]),
                 k4 = rate(stress + k3, a[3]);
    stress += (k1 + 2 * k2 + 2 * k3 + k4) / 6;
    equivalent += (a[0] + 2 * a[1] + 2 * a[2] + a[3]) / 6;
  }
};

}  // namespace railwave
