#include "model/time_step/lanczos.hpp"

#include <Eigen/Eigenvalues>

namespace railwave {

RitzValue largest_ritz_value(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto size = static_cast<Eigen::Index>(diagonal.size());
  const Eigen::VectorXd along = Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size);
  const Eigen::VectorXd off = Eigen::Map<const Eigen::VectorXd>(beside.data(), size - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(along, off);
  const Eigen::Index last = size - 1;
  return {solver.eigenvalues()[last], beside.back() * std::fabs(solver.eigenvectors()(last, last))};
}

}  // namespace railwave
