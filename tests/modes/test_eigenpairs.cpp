#include <Eigen/Eigenvalues>
#include <catch2/catch_test_macros.hpp>

#include "modes/shifted_matrix.hpp"
#include "tests/modes/mode_models.hpp"

using namespace railwave;
using namespace railwave::verify;

TEST_CASE("Eigenpairs: all below a limit, multiple ones in all their copies, whatever the intervals", "[modes]") {
  Model model;
  build_model(mode_block({0.1, 0.1, 0.1}, {5, 5, 5}, 0.1), model);  // pairs and triplets, and six rigid motions
  const ModeUnknowns unknowns(StaticUnknowns(model, model.ties, model.ends, model.beams), model.nodes, model.beams);
  const SpringCollector springs = mode_springs(model.scene, model.connectors.cells, model.beams, model.nodes);
  ShiftedMatrix matrix(stiffness_matrix(model, model.nodes, unknowns, springs), unknowns.mass(), unknowns.places());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix.full(), Eigen::EigenvaluesOnly).eigenvalues();
  const int count = 75;
  int expected = count;
  while (values[expected] - values[expected - 1] < 1e-3 * values[expected]) ++expected;
  const double limit = 0.5 * (values[expected - 1] + values[expected]);
  for (int most : {4, 20, 200}) {
    INFO("intervals of " << most);
    const Eigenpairs pairs = eigenpairs_below(matrix, limit, most);
    REQUIRE(pairs.values.size() == expected);
    CHECK((pairs.values - values.head(expected)).cwiseAbs().maxCoeff() < 1e-10 * limit);
    CHECK((pairs.vectors.transpose() * pairs.vectors - Eigen::MatrixXd::Identity(expected, expected)).norm() < 1e-10);
    double worst = 0;
    for (int k = 0; k < expected; ++k)
      worst = std::max(worst, (matrix.times(pairs.vectors.col(k)) - pairs.values[k] * pairs.vectors.col(k)).norm());
    CHECK(worst < 1e-6 * limit);
  }
}
