#include "model/time_step/stable_step.hpp"

#include <Eigen/Dense>
#include <limits>

#include "kernels/elements/element_modes.hpp"
#include "model/elements/hourglass_scale.hpp"

namespace railwave {
namespace {

using Gradients = Eigen::Matrix<double, 3, 8>;    ///< B
using Hourglasses = Eigen::Matrix<double, 4, 8>;  ///< gamma

Gradients gradients_of(const HexahedronCorners& x) {
  double modes[3][7], B[3][6];
  for (int i = 0; i < 3; ++i) {
    double along_axis[8];
    for (int N = 0; N < 8; ++N) along_axis[N] = x[N][i];
    modes_of(along_axis, modes[i]);
  }
  mean_gradient<double>(modes, B);
  Gradients result = Gradients::Zero();
  for (int i = 0; i < 3; ++i)
    for (int N = 0; N < 8; ++N)
      for (int k = 0; k < 6; ++k) result(i, N) += B[i][k] * mode_sign(k, N);
  return result;
}

Hourglasses hourglasses_of(const HexahedronCorners& x, const Gradients& B, double volume) {
  Hourglasses base;
  Gradients coordinates;
  for (int N = 0; N < 8; ++N) {
    for (int M = 0; M < 4; ++M) base(M, N) = mode_sign(3 + M, N);
    for (int i = 0; i < 3; ++i) coordinates(i, N) = x[N][i];
  }
  const Eigen::Matrix<double, 4, 3> moments = base * coordinates.transpose();
  return base - moments * B / volume;
}

/// Largest eigenvalue of M^-1 K of the mean-gradient stiffness. With Q_ij = 1/V sum_N B_iN B_jN / m_N turned into its
/// principal axes, shear strains have the eigenvalues mu (Q_i + Q_j), and normal strains those of
/// 2 mu diag(Q) + lambda s s^T with s_i = sqrt(Q_i).
double stiffness_eigenvalue(const Eigen::Matrix3d& Q, double lambda, double mu) {
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(Q, Eigen::EigenvaluesOnly).eigenvalues();
  const Eigen::Vector3d root = principal.cwiseMax(0.0).cwiseSqrt();
  const Eigen::Matrix3d normal = Eigen::Matrix3d(2 * mu * principal.asDiagonal()) + lambda * root * root.transpose();
  const double highest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normal, Eigen::EigenvaluesOnly).eigenvalues()[2];
  return std::fmax(highest, mu * (principal[1] + principal[2]));
}

/// The largest dt with (1 - a(dt)) (1 - b(dt)) >= c^2(dt), a <= 1, b <= 1, that is with the largest eigenvalue of
/// [[a, c], [c, b]] at most 1: a = dt^2/4 stiffness, b = dt^2/4 or dt/2 times the hourglass control's, c^2 = coupling
/// times the same factors. a and b bound the two blocks, c what couples them (zero in a parallelepiped of even masses).
double step_of(double stiffness, double control, double coupling, bool viscous) {
  const double alone = viscous ? 2 / control : 2 / std::sqrt(control);
  double high = control > 0 ? std::fmin(2 / std::sqrt(stiffness), alone) : 2 / std::sqrt(stiffness);
  if (!(coupling > 1e-12 * stiffness * control)) return high;
  double low = 0;
  for (int i = 0; i < 40; ++i) {
    const double step = 0.5 * (low + high), on_stiffness = 0.25 * step * step,
                 on_control = viscous ? 0.5 * step : on_stiffness;
    const bool stable =
        (1 - on_stiffness * stiffness) * (1 - on_control * control) >= on_stiffness * on_control * coupling;
    (stable ? low : high) = step;
  }
  return low;
}

}  // namespace

ElementStep element_eigenvalue_step(const HexahedronCorners& x, const scene::Material& material,
                                    scene::HourglassType hourglass, double hourglass_coefficient) {
  const auto integrals = hexahedron_shape_integrals(x);
  double volume = 0;
  Eigen::Matrix<double, 8, 1> inverse_mass;
  for (int N = 0; N < 8; ++N) {
    volume += integrals[N];
    inverse_mass[N] = 1 / (material.density * integrals[N]);
  }
  const double modulus = material.dilatational_modulus(), mu = material.shear_modulus(), lambda = modulus - 2 * mu;
  const bool viscous = hourglass == scene::HourglassType::viscous;
  const double scale = hourglass_scale(hourglass, hourglass_coefficient, material, volume);

  const Gradients B = gradients_of(x);
  const Eigen::Matrix3d Q = B * inverse_mass.asDiagonal() * B.transpose() / volume;
  const double stiffness = stiffness_eigenvalue(Q, lambda, mu);

  const Hourglasses gamma = hourglasses_of(x, B, volume);
  const Eigen::Matrix4d S = gamma * inverse_mass.asDiagonal() * gamma.transpose();
  const double control = scale * S.cwiseAbs().rowwise().sum().maxCoeff();  // Gershgorin; exact in a parallelepiped
  // |R1^T M^-1 R2|^2 of the factors of K = R1 R1^T and of the control = R2 R2^T; 3 lambda + 2 mu bounds the elastic
  // law.
  const double crossed = (B * inverse_mass.asDiagonal() * gamma.transpose()).squaredNorm();
  const double coupling = std::fmax(3 * lambda + 2 * mu, 2 * mu) * scale / volume * crossed;
  const double alone = viscous ? 2 / control : 2 / std::sqrt(control);
  return {step_of(stiffness, control, coupling, viscous),
          control > 0 ? alone : std::numeric_limits<double>::infinity()};
}

}  // namespace railwave
