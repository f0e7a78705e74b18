#include "modes/shifted_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace railwave {
namespace {

constexpr double good_residual = 1e-12, allowed_residual = 1e-8;
constexpr int most_refinements = 20;

/// b - A x, and how large it is beside the terms that it is the difference of.
struct Residual {
  Eigen::VectorXd rest;
  double relative = 0;
};

Residual residual_of(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  Residual residual{b};
  Eigen::VectorXd terms = b.cwiseAbs();
  for (int column = 0; column < lower.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, column); it; ++it) {
      const Eigen::Index row = it.row();
      const double here = it.value() * x[column], mirrored = it.value() * x[row];
      residual.rest[row] -= here;
      terms[row] += std::fabs(here);
      if (row == column) continue;
      residual.rest[column] -= mirrored;
      terms[column] += std::fabs(mirrored);
    }
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const double share = residual.rest[i] == 0 ? 0 : std::fabs(residual.rest[i]) / terms[i];
    if (!(share <= residual.relative)) residual.relative = share;  // not-a-number stays
  }
  return residual;
}

}  // namespace

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
  sigma_ = sigma;
  shifted_ = matrix_;
  for (int k = 0; k < size_; ++k) shifted_.coeffRef(k, k) -= sigma;
  factor_->factorise(shifted_);
}

int ShiftedMatrix::count_below() const { return factor_->negative_pivots() - extra_; }

Eigen::VectorXd ShiftedMatrix::solve(const Eigen::VectorXd& b) const {
  if (extra_ == 0) return refined(b);
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(size_ + extra_);
  whole.head(size_) = b;
  return refined(whole).head(size_);
}

Eigen::VectorXd ShiftedMatrix::refined(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = factor_->solve(b);
  Residual residual = residual_of(shifted_, x, b);
  const double before = residual.relative;
  int count = 0;
  while (residual.relative > good_residual && count < most_refinements) {
    const Eigen::VectorXd better = x + factor_->solve(residual.rest);
    Residual next = residual_of(shifted_, better, b);
    if (!(next.relative < residual.relative)) break;
    x = better;
    residual = std::move(next);
    ++count;
  }
  if (!(residual.relative <= allowed_residual))
    throw InaccurateFactor(fmt::format(
        "the matrix of modes was solved too inaccurately at {:.9g} Hz: a relative residual of {:.1e} is left after {} "
        "refinements, {:.0e} is allowed; another --up-to moves the frequencies at which it is factorised",
        std::sqrt(std::max(sigma_, 0.0)) / (2 * M_PI), residual.relative, count, allowed_residual));
  quality_.before = std::max(quality_.before, before);
  quality_.after = std::max(quality_.after, residual.relative);
  quality_.refinements = std::max(quality_.refinements, count);
  return x;
}

}  // namespace railwave
