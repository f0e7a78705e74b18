#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "modes/stiffness_matrix.hpp"
#include "solve/statics/static_tangent.hpp"
#include "tests/modes/mode_models.hpp"
#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

// The assembled matrix against the operator that element forces make of it, and against the strain energy.
namespace {

/// K q by the matrix-free operator, in the free directions.
Eigen::VectorXd matrix_free(const Model& model, const ModeUnknowns& unknowns, const SpringCollector& springs,
                            const Eigen::VectorXd& q) {
  const StaticUnknowns rows(model, model.ties, model.ends, model.beams);
  StaticTangent tangent(model, model.nodes, rows);
  tangent.set_springs(springs, 0);
  const Eigen::VectorXd motion = unknowns.motion(q);
  std::vector<std::array<double, 3>> values(rows.rows());
  for (int r = 0; r < rows.rows(); ++r)
    for (int i = 0; i < 3; ++i) values[r][i] = motion[3 * r + i];
  const NodeVector u = to_device("u", values), f = to_device("f", values);
  tangent.apply(u, f);
  const auto force = to_host(f);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(unknowns.count());
  for (int r = 0; r < rows.rows(); ++r) {
    if (rows.follows(r)) continue;
    unknowns.each(r, [&](int first, const ModeUnknowns::Shares& shares) {
      result.segment(first, shares.cols()) +=
          shares.transpose() * Eigen::Vector3d(force(r, 0), force(r, 1), force(r, 2));
    });
  }
  return result;
}

void check(const Model& model) {
  const ModeUnknowns unknowns(StaticUnknowns(model, model.ties, model.ends, model.beams), model.nodes, model.beams);
  const SpringCollector springs = mode_springs(model.scene, model.connectors.cells, model.beams, model.nodes);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(unknowns.count()), q = random_vector(unknowns.count(), 3);
  const Eigen::VectorXd expected = matrix_free(model, unknowns, springs, q);
  REQUIRE(expected.norm() > 0);
  for (int most : {0, 100000}) {
    const StiffnessMatrix stiffness = stiffness_matrix(model, model.nodes, unknowns, springs, most);
    const Eigen::VectorXd found = ShiftedMatrix(stiffness, ones, unknowns.places()).times(q);
    INFO(stiffness.extra << " extra rows");
    CHECK((found - expected).norm() < 1e-13 * expected.norm());
  }
  double energy = 0;
  for (double part : StrainEnergy(model, model.nodes, springs)(unknowns.motion(q))) energy += part;
  CHECK_THAT(energy, WithinRel(0.5 * q.dot(expected), 1e-12));
}

}  // namespace

TEST_CASE(
    "Mode matrix: warped elements, oblique constraints, springs and a point mass as the matrix-free operator has them",
    "[modes]") {
  scene::Scene scene = mode_block({0.3, 0.2, 0.1}, {5, 4, 3}, 0.07);
  add_point(scene, "mass", 10, {0.1, 0.1, 0.3});
  add_spring(scene, "mass", "block.z_max", {3e9, 1e9, 2e9}).axes = oblique_axes();
  add_spring(scene, "block.x_max", "ground", {3e9, 1e9, 2e9}).axes = oblique_axes();
  hold(scene, "block.x_min", {false, true, false}).axes = oblique_axes();
  Assembly assembly = assemble(scene);
  warp(assembly, 0.03, 0.2, 5);
  Model model;
  build_model(scene, assembly, model);
  check(model);
}

TEST_CASE("Mode matrix: ties with a gap as the matrix-free operator has them", "[modes]") {
  TiedBlocks blocks;
  blocks.gap = 2e-3;
  Model model;
  build_model(blocks.scene(1e-5), model);
  REQUIRE(model.ties.places.size() == 100);
  check(model);
}

TEST_CASE("Mode matrix: beams on a body as the matrix-free operator has them", "[modes]") {
  scene::Scene scene = mode_block({0.2, 0.1, 0.1}, {4, 2, 2}, 0.05);
  scene.points.push_back(massless("tip", {0.2, 0.1, 0.4}));
  scene::Beam beam = round_beam("tip", "block.z_max", 0.01, 3);
  scene.beams.push_back(beam);
  clamp(scene, "tip");
  Model model;
  build_model(scene, model);
  check(model);
}
