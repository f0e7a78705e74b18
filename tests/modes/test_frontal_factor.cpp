#include <Eigen/Eigenvalues>
#include <catch2/catch_test_macros.hpp>

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
