#include <Eigen/Eigenvalues>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "tests/modes/mode_models.hpp"

using namespace railwave;
using namespace railwave::verify;

TEST_CASE(
    "Frontal factor: solves indefinite systems and counts their negative eigenvalues, springs between many nodes "
    "included",
    "[modes]") {
  scene::Scene scene = mode_block({0.3, 0.2, 0.1}, {9, 6, 4}, 0.05);
  add_spring(scene, "block.x_min", "ground", {1e9, 2e9, 3e9});
  Model model;
  build_model(scene, model);
  const ModeUnknowns unknowns(StaticUnknowns(model, model.ties, model.ends, model.beams), model.nodes, model.beams);
  const SpringCollector springs = mode_springs(model.scene, model.connectors.cells, model.beams, model.nodes);
  const StiffnessMatrix stiffness = stiffness_matrix(model, model.nodes, unknowns, springs);
  REQUIRE(stiffness.extra == 3);
  ShiftedMatrix matrix(stiffness, unknowns.mass(), unknowns.places());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix.full(), Eigen::EigenvaluesOnly).eigenvalues();
  const Eigen::VectorXd right = random_vector(matrix.size(), 7);
  // Three turns about the spring are free.
  for (int below : {0, 3, 7, 40, static_cast<int>(values.size()) - 1}) {
    const double shift = below == 0 ? -values[20] : 0.5 * (values[below - 1] + values[below]);
    matrix.shift_to(shift);
    INFO(below << " eigenvalues below " << shift);
    CHECK(matrix.count_below() == below);
    const Eigen::VectorXd x = matrix.solve(right);
    CHECK((matrix.times(x) - shift * x - right).norm() < 1e-8 * right.norm());
  }
}

namespace {

/// A chain of `count` masses m between two walls, each tied to its neighbours by k, along x: eigenvalues
/// 4 k/m sin^2(j pi / (2 (count + 1))).
StiffnessMatrix chain(int count, double k) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) {
    entries.emplace_back(i, i, 2 * k);
    if (i > 0) entries.emplace_back(i, i - 1, -k);
  }
  StiffnessMatrix stiffness;
  stiffness.lower.resize(count, count);
  stiffness.lower.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

std::vector<Vec3> places(int count) {
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i) result.push_back({0.1 * i, 0, 0});
  return result;
}

}  // namespace

TEST_CASE("Solves with small pivots are refined until they are exact to rounding", "[modes]") {
  // At sigma = 2 k/m (1 - share) the first pivot of each front is 2 share k/m, while the nearest eigenvalue is 0.5 %
  // off: the factors alone lose as many digits as the share is small.
  constexpr int count = 300;
  constexpr double k = 3e8, mass = 0.7;
  Eigen::VectorXd exact(count);
  for (int i = 0; i < count; ++i) exact[i] = std::sin(0.37 * i) + 0.2 * std::cos(1.9 * i);
  for (const double share : {1e-4, 1e-8, 1e-12, 1e-14}) {
    ShiftedMatrix matrix(chain(count, k), Eigen::VectorXd::Constant(count, mass), places(count));
    const double sigma = (1 - share) * 2 * k / mass;
    matrix.shift_to(sigma);
    const Eigen::VectorXd x = matrix.solve(matrix.times(exact) - sigma * exact);
    INFO("pivots of " << share << ": relative residual " << matrix.quality().before << ", " << matrix.quality().after
                      << " after " << matrix.quality().refinements);
    CHECK((x - exact).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(matrix.quality().after < 1e-12);
    CHECK((matrix.quality().before > 1e-8) == (share < 1e-7));
    CHECK(matrix.quality().refinements > 0);
  }
}
