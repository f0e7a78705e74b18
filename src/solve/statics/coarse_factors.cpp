#include "solve/statics/coarse_factors.hpp"

#include <Eigen/Dense>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace railwave {
namespace {

using Block = CoarseFactors::Block;
using Rows = std::vector<std::vector<int>>;  ///< of each column the rows below its diagonal, ascending

/// Places in the order of elimination, by aggregate.
std::vector<int> order_of_elimination(int aggregates, const CoarseFactors::Blocks& blocks) {
  std::vector<Eigen::Triplet<double>> coupled;
  for (const auto& [at, block] : blocks) coupled.emplace_back(at.first, at.second, 1.0);
  Eigen::SparseMatrix<double> graph(aggregates, aggregates);
  graph.setFromTriplets(coupled.begin(), coupled.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), order);
  std::vector<int> place(aggregates);
  for (int k = 0; k < aggregates; ++k) place[order.indices()[k]] = k;
  return place;
}

/// Of the factors from those of the matrix, in any order: a column has all rows of those columns whose first row it is.
Rows filled_rows(Rows rows) {
  for (std::size_t column = 0; column < rows.size(); ++column) {
    std::vector<int>& own = rows[column];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (!own.empty()) rows[own.front()].insert(rows[own.front()].end(), own.begin() + 1, own.end());
  }
  return rows;
}

/// L D L^T of a block's lower triangle, in place; above it 0. @return D
CoarseFactors::Vector factor_diagonal(Block& a) {
  CoarseFactors::Vector pivots;
  for (int k = 0; k < CoarseFactors::motions; ++k) {
    const double pivot = pivots[k] = a(k, k);
    if (!(std::fabs(pivot) > 0)) throw std::runtime_error("the static equilibrium's coarse stiffness is singular");
    for (int j = k + 1; j < CoarseFactors::motions; ++j)
      for (int i = j; i < CoarseFactors::motions; ++i) a(i, j) -= a(i, k) * (a(j, k) / pivot);
    for (int i = k + 1; i < CoarseFactors::motions; ++i) a(i, k) /= pivot;
    for (int i = 0; i < k; ++i) a(i, k) = 0;
    a(k, k) = 1;
  }
  return pivots;
}

}  // namespace

CoarseFactors::CoarseFactors(int aggregates, const Blocks& blocks)
    : place_(order_of_elimination(aggregates, blocks)), diagonal_(aggregates), first_(1, 0), pivots_(aggregates) {
  const auto placed = [this](const std::pair<int, int>& at) {
    return std::minmax(place_[at.first], place_[at.second]);
  };
  Rows rows(aggregates);
  for (const auto& [at, block] : blocks)
    if (at.first != at.second) rows[placed(at).first].push_back(placed(at).second);
  for (const std::vector<int>& of_column : filled_rows(std::move(rows))) {
    row_.insert(row_.end(), of_column.begin(), of_column.end());
    first_.push_back(static_cast<int>(row_.size()));
  }
  below_.assign(row_.size(), Block::Zero());
  for (const auto& [at, block] : blocks) {
    const auto [column, row] = placed(at);
    if (row == column)
      diagonal_[column] = block;
    else
      *find(row, column) = place_[at.first] == row ? block : Block(block.transpose());
  }
  for (int a = 0; a < aggregates; ++a) eliminate(a);
}

Block* CoarseFactors::find(int row, int column) {
  const auto begin = row_.begin() + first_[column], end = row_.begin() + first_[column + 1];
  return &below_[std::lower_bound(begin, end, row) - row_.begin()];
}

/// Column a becomes L's; what it takes from others' blocks is taken.
void CoarseFactors::eliminate(int a) {
  pivots_[a] = factor_diagonal(diagonal_[a]);
  const int begin = first_[a], end = first_[a + 1];
  std::vector<Block> scaled(end - begin);  // L D
  for (int k = begin; k < end; ++k) {
    scaled[k - begin] = diagonal_[a].triangularView<Eigen::UnitLower>().solve(below_[k].transpose()).transpose();
    below_[k] = scaled[k - begin] * pivots_[a].cwiseInverse().asDiagonal();
  }
  for (int j = begin; j < end; ++j) {
    const Block right = below_[j].transpose();
    diagonal_[row_[j]].noalias() -= scaled[j - begin] * right;
    // Column j has all these rows, in the same order.
    int at = first_[row_[j]];
    for (int i = j + 1; i < end; ++i) {
      while (row_[at] != row_[i]) ++at;
      below_[at].noalias() -= scaled[i - begin] * right;
    }
  }
}

void CoarseFactors::solve(double* x) const {
  const int aggregates = static_cast<int>(place_.size());
  std::vector<Vector> y(aggregates);
  for (int a = 0; a < aggregates; ++a) y[place_[a]] = Eigen::Map<const Vector>(x + a * motions);
  for (int a = 0; a < aggregates; ++a) {
    diagonal_[a].triangularView<Eigen::UnitLower>().solveInPlace(y[a]);
    const Vector own = y[a];
    for (int k = first_[a]; k < first_[a + 1]; ++k) y[row_[k]].noalias() -= below_[k] * own;
  }
  for (int a = aggregates; a-- > 0;) {
    Vector own = y[a].cwiseQuotient(pivots_[a]);
    for (int k = first_[a]; k < first_[a + 1]; ++k) own.noalias() -= below_[k].transpose() * y[row_[k]];
    diagonal_[a].transpose().triangularView<Eigen::UnitUpper>().solveInPlace(own);
    y[a] = own;
  }
  for (int a = 0; a < aggregates; ++a) Eigen::Map<Vector>(x + a * motions) = y[place_[a]];
}

}  // namespace railwave
