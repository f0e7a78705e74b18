#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Both blocks free; the upper one flies down at `speed` and must cross a gap of 1 um.
scene::Scene falling_block(const TwoBlocks& blocks, double speed, double end) {
  TwoBlocks apart = blocks;
  apart.gap = 1e-6;
  scene::Scene scene = apart.scene(end);
  // Corner nodes have the whole contact spring on a quarter of the mass; and an impact is a shock, whose energy error
  // goes with the step squared.
  scene.time.step_scale = 0.5;
  for (scene::Part& part : scene.parts) part.hourglass = scene::HourglassType::stiffness;
  add_motion(scene, {"upper"}, {0, 0, -speed});
  return scene;
}

struct Impact {
  double momentum = 0;      ///< worst change over the momentum brought in
  double imbalance = 0;     ///< worst, over the energy brought in
  double reaction = 0;      ///< worst difference of the contact force and its reaction, over the largest force
  double last_contact = 0;  ///< s
  double first_contact = -1;
  Vec3 upper{}, lower{};  ///< mean velocities at the end
};

Impact impact(const scene::Scene& scene, double speed) {
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  const double mass = mass_of(model, "upper");
  const auto nodes = all_nodes(model);
  Impact result;
  double first = 0, largest_force = 0;
  march(model, model.step_count, [&] {
    const auto v = to_host(model.nodes.velocity);
    Vec3 momentum{0, 0, mass * speed};
    for (int n : nodes)
      for (int i = 0; i < 3; ++i) momentum[i] += model.mass[n] * v(n, i);
    result.momentum = std::max(result.momentum, norm(momentum) / (mass * speed));
    const double total = balance_total(account_energies(model, model.step_size));
    if (model.step == 0) first = total;
    result.imbalance = std::max(result.imbalance, std::fabs(total - first) / (0.5 * mass * speed * speed));
    const ContactTotals totals = contact_totals(model, model.contacts, 0);
    // Not over the present force: at a moment of parting that is a few quanta of what forces are added in.
    largest_force = std::max(largest_force, norm(totals.normal_force));
    result.reaction =
        std::max(result.reaction, norm(totals.normal_force + totals.tangential_force + totals.master_force));
    if (totals.nodes_in_contact == 0) return;
    if (result.first_contact < 0) result.first_contact = model.time;
    result.last_contact = model.time;
  });
  result.reaction /= largest_force;
  result.upper = mean(model, NodeField::velocity, model.assembly.node_sets.at("upper"));
  result.lower = mean(model, NodeField::velocity, model.assembly.node_sets.at("lower"));
  return result;
}

}  // namespace

TEST_CASE("two equal bars held sideways exchange their velocities after twice a wave's travel") {
  for (auto algorithm : both_algorithms) {
    TwoBlocks bars;
    bars.algorithm = algorithm;
    bars.upper_size = bars.lower_size = {0.01, 0.01, 0.1};
    bars.upper_divisions = bars.lower_divisions = {2, 2, 80};
    const double duration = 2 * 0.1 / steel().dilatational_speed();
    scene::Scene scene = falling_block(bars, 1.0, 2 * duration);
    hold(scene, "upper", {true, true, false});
    hold(scene, "lower", {true, true, false});
    const Impact result = impact(scene, 1.0);
    INFO(name_of(algorithm) << ": upper " << result.upper[2] << ", lower " << result.lower[2] << ", contact for "
                            << (result.last_contact - result.first_contact) / duration << " of 2 L/c, imbalance "
                            << result.imbalance);
    CHECK_THAT(result.last_contact - result.first_contact, WithinRel(duration, 0.05));
    CHECK_THAT(result.upper[2], WithinAbs(0, 0.02));
    CHECK_THAT(result.lower[2], WithinAbs(-1, 0.02));
    CHECK(result.momentum < 1e-11);
    CHECK(result.imbalance < 0.01);
    CHECK(result.reaction < 1e-12);
  }
}

TEST_CASE("blocks of different meshes and sizes that meet off centre keep momentum and energy") {
  for (auto [algorithm, friction] : {std::pair{scene::ContactAlgorithm::penalty, 0.0},
                                     {scene::ContactAlgorithm::penalty, 0.4},
                                     {scene::ContactAlgorithm::multiplier, 0.0},
                                     {scene::ContactAlgorithm::multiplier, 0.4}}) {
    TwoBlocks blocks;
    blocks.algorithm = algorithm;
    blocks.upper_divisions = {7, 6, 2};
    blocks.lower_size = {0.06, 0.06, 0.01};
    blocks.lower_divisions = {11, 10, 3};
    blocks.friction = friction;
    scene::Scene scene = falling_block(blocks, 5.0, 6e-5);
    scene.parts[0].position = scene.parts[0].position + Vec3{0.0123, -0.0071, 0};
    scene.initial_motions[0].angular_velocity = {20, -30, 0};
    const Impact result = impact(scene, 5.0);
    INFO(name_of(algorithm) << ", friction " << friction << ", imbalance " << result.imbalance << ", rebound "
                            << result.upper[2]);
    CHECK(result.first_contact >= 0);
    CHECK(result.momentum < 1e-11);
    CHECK(result.imbalance < 0.01);
    CHECK(result.reaction < 1e-12);
  }
}

TEST_CASE("what friction takes of a block that comes at a slant is booked from the first touch on") {
  for (const auto normals : {scene::ContactNormals::facet, scene::ContactNormals::smooth}) {
    TwoBlocks blocks;
    blocks.algorithm = scene::ContactAlgorithm::multiplier;
    blocks.friction = 2;  // sticks at once
    scene::Scene scene = falling_block(blocks, 2.0, 2e-5);
    scene.initial_motions[0].velocity[0] = 4;
    scene.contacts[0].normals = normals;
    const Impact result = impact(scene, 2.0);
    INFO("imbalance " << result.imbalance << " of the energy of the fall");
    CHECK(result.first_contact >= 0);
    CHECK(result.imbalance < 0.005);
  }
}
