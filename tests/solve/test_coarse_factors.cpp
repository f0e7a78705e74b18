#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <random>
#include <stdexcept>

#include "solve/statics/coarse_factors.hpp"

using namespace railwave;

namespace {

constexpr int motions = CoarseFactors::motions;
using Block = CoarseFactors::Block;

/// Of aggregates in a ring, some of which others far away touch, too.
struct Coupled {
  int aggregates;
  CoarseFactors::Blocks blocks;

  Coupled(int count, int far, unsigned seed) : aggregates(count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    std::uniform_int_distribution<int> any(0, count - 1);
    const auto some = [&] { return Block::NullaryExpr([&] { return value(random); }).eval(); };
    for (int a = 0; a < count; ++a) blocks[{a, a}] = some();
    for (int a = 1; a < count; ++a) blocks[{a, a - 1}] = some();
    if (count > 2) blocks[{count - 1, 0}] = some();
    for (int k = 0; k < far; ++k) {
      const int a = any(random), b = any(random);
      if (a != b) blocks[{std::max(a, b), std::min(a, b)}] = some();
    }
    for (int a = 0; a < count; ++a) blocks[{a, a}].diagonal().array() += 60;
  }

  Eigen::MatrixXd dense() const {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(aggregates * motions, aggregates * motions);
    for (const auto& [at, block] : blocks)
      matrix.block<motions, motions>(at.first * motions, at.second * motions) = block;
    return matrix.selfadjointView<Eigen::Lower>();
  }
};

double error_of(const Coupled& coupled) {
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(coupled.aggregates * motions, -1, 2);
  Eigen::VectorXd x = right;
  CoarseFactors(coupled.aggregates, coupled.blocks).solve(x.data());
  return (coupled.dense() * x - right).norm() / right.norm();
}

}  // namespace

TEST_CASE("the coarse stiffness is solved as a dense matrix, however its aggregates are coupled") {
  for (const int aggregates : {1, 2, 7, 60})
    for (const int far : {0, 3, 200}) {
      INFO(aggregates << " aggregates, " << far << " far couplings");
      CHECK(error_of(Coupled(aggregates, far, 7 * aggregates + far)) < 1e-13);
    }
}

TEST_CASE("an indefinite coarse stiffness is solved, a singular one refused") {
  Coupled coupled(20, 10, 1);
  for (int a = 0; a < 20; a += 3) coupled.blocks[{a, a}] *= -1;
  CHECK(error_of(coupled) < 1e-13);
  coupled.blocks.clear();
  for (int a = 0; a < 3; ++a) coupled.blocks[{a, a}] = Block::Identity();
  coupled.blocks[{1, 1}](4, 4) = 0;
  CHECK_THROWS_AS(CoarseFactors(3, coupled.blocks), std::runtime_error);
}
