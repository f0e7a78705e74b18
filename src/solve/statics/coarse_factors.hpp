#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "kernels/statics/static_solve.hpp"

namespace railwave {

/// E = L D L^T of the static start's coarse stiffness, sparse, by blocks of two aggregates' motions. A solution asks
/// memory for blocks alone, not for each of their entries' row, and computes with whole ones.
class CoarseFactors {
 public:
  static constexpr int motions = CoarseModes::of_aggregate;
  using Block = Eigen::Matrix<double, motions, motions>;
  using Vector = Eigen::Matrix<double, motions, 1>;
  using Blocks = std::map<std::pair<int, int>, Block>;  ///< row aggregate >= column aggregate

  /// @param blocks of E; of those on the diagonal, which all aggregates have, the lower triangle counts
  /// Throws std::runtime_error where a pivot vanishes.
  CoarseFactors(int aggregates, const Blocks& blocks);

  /// x = E^-1 x. @param x `motions` values of each aggregate
  void solve(double* x) const;

 private:
  Block* find(int row, int column);
  void eliminate(int a);

  // In the order in which they are eliminated, which keeps most of L zero (Amestoy, Davis and Duff 1996):
  std::vector<int> place_;       ///< by aggregate
  std::vector<Block> diagonal_;  ///< of L, whose own diagonal is 1
  std::vector<int> first_;       ///< of the blocks below it; one more
  std::vector<int> row_;
  std::vector<Block> below_;
  std::vector<Vector> pivots_;
};

}  // namespace railwave
