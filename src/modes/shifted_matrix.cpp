#include "modes/shifted_matrix.hpp"

#include <cmath>

namespace railwave {

ShiftedMatrix::ShiftedMatrix(const StiffnessMatrix& stiffness, const Eigen::VectorXd& mass,
                             const std::vector<Vec3>& place)
    : size_(static_cast<int>(mass.size())), extra_(stiffness.extra), matrix_(stiffness.lower) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(size_ + extra_);
  scale.head(size_) = mass.cwiseSqrt().cwiseInverse();
  // The extra rows' own scale is free; with -1 on the diagonal they are as large as others.
  for (int k = size_; k < size_ + extra_; ++k) scale[k] = 1 / std::sqrt(-matrix_.coeff(k, k));
  matrix_ = scale.asDiagonal() * matrix_ * scale.asDiagonal();
  factor_ = std::make_unique<FrontalFactor>(matrix_, place);
}

Eigen::VectorXd ShiftedMatrix::times(const Eigen::VectorXd& x) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(size_ + extra_);
  whole.head(size_) = x;
  const auto symmetric = matrix_.selfadjointView<Eigen::Lower>();
  if (extra_ > 0) whole.tail(extra_) = Eigen::VectorXd(symmetric * whole).tail(extra_);
  return Eigen::VectorXd(symmetric * whole).head(size_);
}

Eigen::MatrixXd ShiftedMatrix::full() const {
  Eigen::MatrixXd result(size_, size_);
  for (int k = 0; k < size_; ++k) result.col(k) = times(Eigen::VectorXd::Unit(size_, k));
  return 0.5 * (result + result.transpose());
}

void ShiftedMatrix::shift_to(double sigma) {
  shifted_ = matrix_;
  for (int k = 0; k < size_; ++k) shifted_.coeffRef(k, k) -= sigma;
  factor_->factorise(shifted_);
}

int ShiftedMatrix::count_below() const { return factor_->negative_pivots() - extra_; }

Eigen::VectorXd ShiftedMatrix::solve(const Eigen::VectorXd& x) const {
  if (extra_ == 0) return factor_->solve(x);
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(size_ + extra_);
  whole.head(size_) = x;
  return Eigen::VectorXd(factor_->solve(whole)).head(size_);
}

}  // namespace railwave
