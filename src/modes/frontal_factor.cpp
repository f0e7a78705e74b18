#include "modes/frontal_factor.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

namespace railwave {
namespace {

using Matrix = Eigen::MatrixXd;
constexpr int panel = 48;  ///< columns eliminated together

[[noreturn]] void vanished() {
  throw InaccurateFactor("a pivot vanished while the matrix of modes was factorised; another --up-to may help");
}

/// L D L^T of a small block's lower triangle, in place.
void factorise_block(Eigen::Ref<Matrix> a, Eigen::Ref<Eigen::VectorXd> pivots) {
  const Eigen::Index n = a.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    const double pivot = pivots[k] = a(k, k);
    if (!(std::fabs(pivot) > 0)) vanished();
    const Eigen::Index rest = n - k - 1;
    const Eigen::VectorXd column = a.col(k).tail(rest);
    a.col(k).tail(rest) /= pivot;
    for (Eigen::Index j = 0; j < rest; ++j)
      a.col(k + 1 + j).tail(rest - j) -= (column[j] / pivot) * column.tail(rest - j);
  }
}

/// Eliminates the first `count` rows and columns of a symmetric matrix whose lower triangle is given: those columns
/// become L's, the rest what is left of the matrix.
void eliminate(Matrix& a, int count, Eigen::VectorXd& pivots) {
  pivots.resize(count);
  const Eigen::Index size = a.rows();
  for (int first = 0; first < count; first += panel) {
    const int width = std::min(panel, count - first);
    const Eigen::Index below = first + width, rest = size - below;
    factorise_block(a.block(first, first, width, width), pivots.segment(first, width));
    if (rest == 0) continue;
    auto own = a.block(below, first, rest, width);
    a.block(first, first, width, width)
        .triangularView<Eigen::UnitLower>()
        .transpose()
        .solveInPlace<Eigen::OnTheRight>(own);
    const Matrix before = own;  // L D
    own = before * pivots.segment(first, width).cwiseInverse().asDiagonal();
    for (Eigen::Index column = below; column < size; column += 4 * panel) {
      const Eigen::Index columns = std::min<Eigen::Index>(4 * panel, size - column);
      a.block(column, column, size - column, columns).noalias() -=
          own.bottomRows(size - column) * before.middleRows(column - below, columns).transpose();
    }
  }
}

}  // namespace

FrontalFactor::FrontalFactor(const Eigen::SparseMatrix<double>& lower, const std::vector<std::array<double, 3>>& place)
    : order_(nested_dissection(lower, place)), children_(order_.fronts.size()), columns_(order_.fronts.size()) {
  for (std::size_t f = 0; f < order_.fronts.size(); ++f) {
    const Front& front = order_.fronts[f];
    if (front.parent >= 0) children_[front.parent].push_back(static_cast<int>(f));
    const long own = static_cast<long>(front.own.size());
    entries_ += own * (own + 1) / 2 + own * static_cast<long>(front.border.size());
  }
}

void FrontalFactor::factorise(const Eigen::SparseMatrix<double>& lower) {
  const auto& number = order_.new_number;
  // By new numbers: each entry in the column that is eliminated first.
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(lower.nonZeros());
  for (int column = 0; column < lower.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, column); it; ++it) {
      const int a = number[it.row()], b = number[column];
      entries.emplace_back(std::max(a, b), std::min(a, b), it.value());
    }
  Eigen::SparseMatrix<double> matrix(lower.rows(), lower.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  entries = {};

  negative_ = 0;
  std::vector<Matrix> left(order_.fronts.size());
  std::vector<int> at(lower.rows(), -1);
  for (std::size_t f = 0; f < order_.fronts.size(); ++f) {
    const Front& front = order_.fronts[f];
    const int own = static_cast<int>(front.own.size()), border = static_cast<int>(front.border.size());
    for (int k = 0; k < own; ++k) at[front.first + k] = k;
    for (int k = 0; k < border; ++k) at[front.border[k]] = own + k;
    Matrix a = Matrix::Zero(own + border, own + border);
    for (int k = 0; k < own; ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, front.first + k); it; ++it)
        a(at[it.row()], k) += it.value();
    for (int child : children_[f]) {
      const std::vector<int>& rows = order_.fronts[child].border;
      for (std::size_t j = 0; j < rows.size(); ++j)
        for (std::size_t i = j; i < rows.size(); ++i) a(at[rows[i]], at[rows[j]]) += left[child](i, j);
      left[child] = {};
    }
    Columns& columns = columns_[f];
    eliminate(a, own, columns.pivots);
    columns.lower = a.leftCols(own);
    if (border > 0) left[f] = a.bottomRightCorner(border, border);
    negative_ += static_cast<int>((columns.pivots.array() < 0).count());
  }
}

Eigen::VectorXd FrontalFactor::solve(const Eigen::VectorXd& right) const {
  const auto& number = order_.new_number;
  Eigen::VectorXd x(right.size());
  for (Eigen::Index k = 0; k < right.size(); ++k) x[number[k]] = right[k];
  Eigen::VectorXd border;
  for (std::size_t f = 0; f < order_.fronts.size(); ++f) {
    const Front& front = order_.fronts[f];
    const Eigen::Index own = static_cast<Eigen::Index>(front.own.size()),
                       beside = static_cast<Eigen::Index>(front.border.size());
    auto mine = x.segment(front.first, own);
    columns_[f].lower.topRows(own).triangularView<Eigen::UnitLower>().solveInPlace(mine);
    border.noalias() = columns_[f].lower.bottomRows(beside) * mine;
    for (Eigen::Index k = 0; k < beside; ++k) x[front.border[k]] -= border[k];
    mine.array() /= columns_[f].pivots.array();
  }
  for (std::size_t f = order_.fronts.size(); f-- > 0;) {
    const Front& front = order_.fronts[f];
    const Eigen::Index own = static_cast<Eigen::Index>(front.own.size()),
                       beside = static_cast<Eigen::Index>(front.border.size());
    auto mine = x.segment(front.first, own);
    border.resize(beside);
    for (Eigen::Index k = 0; k < beside; ++k) border[k] = x[front.border[k]];
    mine.noalias() -= columns_[f].lower.bottomRows(beside).transpose() * border;
    columns_[f].lower.topRows(own).triangularView<Eigen::UnitLower>().transpose().solveInPlace(mine);
  }
  Eigen::VectorXd result(right.size());
  for (Eigen::Index k = 0; k < right.size(); ++k) result[k] = x[number[k]];
  return result;
}

}  // namespace railwave
