#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "model/host_copy.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;

namespace {

/// Settles and checks that the contact carries the upper block's weight, along `up`.
void check_rest(const scene::Scene& scene, const Assembly& assembly, const Vec3& up) {
  Model model;
  build_model(scene, assembly, model);
  const double weight = norm(scene.gravity) * mass_of(model, "upper");
  const SettleReport report = settle_whole(model);
  INFO("unbalance " << report.unbalance << " after " << report.steps << " steps");
  CHECK(report.settled);
  double worst = 0, reaction = 0;
  march(model, 200, [&] {
    const ContactTotals totals = contact_totals(model, model.contacts, 0);
    worst = std::max(worst, norm(totals.normal_force - weight * up) / weight);
    reaction = std::max(reaction, reaction_error(totals));
    CHECK(totals.nodes_in_contact > 0);
  });
  INFO("contact force against weight: worst relative difference " << worst << ", against the master's " << reaction);
  // The unbalance is relative to all forces applied: the weights of both blocks, nine of the upper one, and the
  // contact's.
  CHECK(worst < 10 * scene.settle.tolerance);
  CHECK(reaction < 1e-12);
}

scene::Scene resting(const TwoBlocks& blocks, const Vec3& up) {
  scene::Scene scene = blocks.scene(1e-3);
  scene.gravity = (-1e5) * up;
  scene.time.step_scale = 0.6;  // edge and corner nodes bear the whole contact spring on a part of the mass
  // Settling leans on stiffness control; a viscous one would let go of what that holds when the run begins.
  for (scene::Part& part : scene.parts) part.hourglass = scene::HourglassType::stiffness;
  scene.settle.active = true;
  scene.settle.tolerance = 1e-4;
  hold(scene, "lower.z_min", {true, true, true});
  return scene;
}

}  // namespace

TEST_CASE("a block at rest on another presses with its weight, equal and opposite, on matching and other meshes") {
  for (auto algorithm : both_algorithms)
    for (auto upper_divisions : {std::array<int, 3>{8, 8, 2}, {5, 7, 2}, {13, 11, 3}}) {
      TwoBlocks blocks;
      blocks.algorithm = algorithm;
      blocks.upper_divisions = upper_divisions;
      const scene::Scene scene = resting(blocks, {0, 0, 1});
      INFO(name_of(algorithm) << ", divisions along x " << upper_divisions[0]);
      check_rest(scene, assemble(scene), {0, 0, 1});
    }
}

TEST_CASE("a block at rest in askew axes presses with its weight") {
  const auto axes = oblique_axes();
  TwoBlocks blocks;
  blocks.upper_divisions = {5, 7, 2};
  const scene::Scene scene = resting(blocks, axes[2]);
  Assembly assembly = assemble(scene);
  for (Vec3& x : assembly.nodes) x = turned(axes, x);
  check_rest(scene, assembly, axes[2]);
}

TEST_CASE("without friction while it settles a contact begins the run without shear, and has its friction again") {
  for (auto algorithm : both_algorithms)
    for (bool friction : {true, false}) {
      TwoBlocks blocks;
      blocks.algorithm = algorithm;
      blocks.friction = 0.4;
      blocks.upper_divisions = {5, 7, 2};
      scene::Scene scene = resting(blocks, {0, 0, 1});
      scene.settle.friction = friction;
      hold(scene, "upper.z_max", {true, true, false});
      Model model;
      build_model(scene, model);
      CHECK(settle_whole(model).settled);
      double shear = 0;
      const auto tangential = to_host(model.contacts[0].arrays.tangential_force);
      for (std::size_t s = 0; s < tangential.extent(0); ++s)
        shear = std::max(shear, std::hypot(tangential(s, 0), tangential(s, 1)));
      INFO(name_of(algorithm) << (friction ? ", friction" : ", no friction")
                              << " while settling: largest shear force of a node " << shear << " N");
      if (friction)
        CHECK(shear > 1);
      else
        CHECK(shear == 0);
      CHECK(model.contacts[0].arrays.friction == 0.4);
    }
}

TEST_CASE("close_gap moves the slave's part along its direction until it touches") {
  TwoBlocks blocks;
  blocks.gap = 3e-3;
  scene::Scene scene = blocks.scene(1e-3);
  scene.contacts[0].close_gap = Vec3{0, 4, -3};  // any length: 0.8 aside for 0.6 down
  const Assembly assembly = assemble(scene);
  const Assembly before = assemble(blocks.scene(1e-3));
  for (int n : assembly.node_sets.at("upper")) {
    CHECK_THAT(assembly.nodes[n][0], WithinAbs(before.nodes[n][0], 1e-15));
    CHECK_THAT(assembly.nodes[n][1], WithinAbs(before.nodes[n][1] + 4e-3, 1e-15));
    CHECK_THAT(assembly.nodes[n][2], WithinAbs(before.nodes[n][2] - 3e-3, 1e-15));
  }
  for (int n : assembly.node_sets.at("lower")) CHECK(assembly.nodes[n] == before.nodes[n]);
}
