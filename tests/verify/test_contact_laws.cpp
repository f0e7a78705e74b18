#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

/// Growing penalty and contact damping: equilibrium, energy account, decay, and the stable step with them.
using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

/// A block thrown at a held one.
struct Throw {
  double imbalance = 0, largest_contact = 0, kinetic_before = 0;
  EnergyAccount last;
};

Throw thrown(double damping, const std::vector<std::array<double, 2>>& growth, double friction,
             double step_scale = 0.5) {
  TwoBlocks blocks;
  blocks.upper_divisions = {4, 4, 2};
  blocks.lower_divisions = {6, 6, 2};
  blocks.gap = 1e-5;
  blocks.friction = friction;
  scene::Scene scene = blocks.scene(1.2e-4);
  scene.contacts[0].damping = damping;
  scene.contacts[0].penalty_growth = growth;
  scene.time.step_scale = step_scale;
  hold(scene, "lower.z_min", {true, true, true});
  // Stiffness control stores what it takes; the loss of a viscous one is booked to first order only.
  for (scene::Part& part : scene.parts) set_hourglass(part, scene::HourglassType::stiffness, 0.05);
  add_motion(scene, {"upper"}, {friction > 0 ? 3.0 : 0.0, 0, -2});
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  Throw result;
  double first = 0;
  march(model, model.step_count, [&] {
    result.last = account_energies(model, model.step_size);
    if (model.step == 0) {
      first = balance_total(result.last);
      result.kinetic_before = result.last.kinetic;
    }
    result.largest_contact = std::max(result.largest_contact, result.last.contact);
    result.imbalance = std::max(result.imbalance, std::fabs(balance_total(result.last) - first));
  });
  return result;
}

const std::vector<std::array<double, 2>> growing = {{0, 0.2}, {4e-6, 3}, {1e-5, 6}};

}  // namespace

TEST_CASE("the energy account holds in an impact on a penalty that grows, with damping and without") {
  for (double friction : {0.0, 0.3})
    for (double damping : {0.0, 0.3})
      for (bool grows : {false, true}) {
        const Throw result = thrown(damping, grows ? growing : std::vector<std::array<double, 2>>{}, friction);
        INFO("friction " << friction << ", damping " << damping << ", grows " << grows << ": imbalance "
                         << result.imbalance / result.kinetic_before
                         << " of the kinetic energy, contact stored at most "
                         << result.largest_contact / result.kinetic_before << ", damped "
                         << result.last.damping / result.kinetic_before);
        CHECK(result.largest_contact > 0.02 * result.kinetic_before);
        CHECK(result.imbalance < 0.01 * result.kinetic_before);
        if (damping > 0)
          CHECK(result.last.damping > 0.01 * result.kinetic_before);
        else
          CHECK(result.last.damping == 0);
      }
}

TEST_CASE("a block at rest on a growing penalty sinks in until the law gives its weight") {
  TwoBlocks blocks;
  blocks.upper_divisions = {4, 4, 2};
  blocks.lower_divisions = {6, 6, 2};
  scene::Scene scene = blocks.scene(1e-3);
  scene.gravity = {0, 0, -1e6};
  scene.contacts[0].penalty_growth = growing;
  hold(scene, "lower", {true, true, true});
  scene.settle.active = true;
  scene.settle.tolerance = 1e-5;
  Model model;
  build_model(scene, model);
  REQUIRE(settle_whole(model).settled);
  compute_forces(model);
  const ContactState state = contact_state(model, model.ties, model.contacts, 0);
  const double stiffness = model.contacts[0].segment_stiffness[0];
  double total = 0, deepest = 0;
  for (std::size_t s = 0; s < state.gap.size(); ++s) {
    const double depth = -state.gap[s], force = state.slave.normal_force[3 * s + 2];
    if (!(depth > 0)) continue;
    // By the midpoint rule, which knows no corners of the law.
    double sum = 0;
    const int pieces = 20000;
    for (int k = 0; k < pieces; ++k) {
      const double l = (k + 0.5) / pieces * depth;
      sum += (l < 4e-6 ? 0.2 + 2.8 * l / 4e-6 : l < 1e-5 ? 3 + 3 * (l - 4e-6) / 6e-6 : 6) * depth / pieces;
    }
    CHECK_THAT(force, WithinRel(stiffness * sum, 1e-6));
    total += force;
    deepest = std::max(deepest, depth);
  }
  INFO("deepest penetration " << deepest);
  CHECK(deepest > 5e-7);
  CHECK_THAT(total, WithinRel(1e6 * mass_of(model, "upper"), 1e-3));
}

TEST_CASE("a cube that bounces on damped contact springs calms down at the rate that their critical share gives") {
  // Springs so soft that the cube is rigid on them, and pressed so that it never leaves.
  const double share = 0.05, scale = 1e-3;
  TwoBlocks blocks;
  blocks.upper_size = {0.01, 0.01, 0.01};
  blocks.upper_divisions = {1, 1, 1};
  blocks.lower_size = {0.03, 0.03, 0.01};
  blocks.lower_divisions = {3, 3, 1};
  scene::Scene scene = blocks.scene(1.5e-3);
  scene.contacts[0].penalty_scale = scale;
  scene.time.step_scale = 0.6;  // a lone cube's limit is 0.73
  scene.contacts[0].damping = share;
  scene.gravity = {0, 0, -1e5};
  hold(scene, "lower", {true, true, true});
  Model model;
  build_model(scene, model);
  const double stiffness = model.contacts[0].segment_stiffness[0], mass = mass_of(model, "upper"), sum = 4 * stiffness;
  // It begins where the springs carry it, moving.
  const double sunk = mass * 1e5 / sum, omega = std::sqrt(sum / mass);
  std::vector<char> on_cube(model.nodes.count, 0);
  for (int n : model.assembly.node_sets.at("upper")) on_cube[n] = 1;
  set_position(model, [&](const Vec3& x, int n) { return on_cube[n] ? x + Vec3{0, 0, -sunk} : x; });
  set_velocity(model, [&](const Vec3&, int n) { return Vec3{0, 0, on_cube[n] ? 0.3 * sunk * omega : 0}; });
  const auto& upper = model.assembly.node_sets.at("upper");
  std::vector<double> height;
  march(model, model.step_count, [&] {
    height.push_back(mean(model, NodeField::displacement, upper)[2]);
    CHECK(contact_totals(model, model.contacts, 0).nodes_in_contact == 4);
  });
  // Of the rigid cube: four dashpots on its whole mass; each is a share of critical for a corner's mass against the
  // segment's where it stands (a corner on a corner: one node).
  const double corner = model.mass[upper.front()];
  std::vector<double> peaks;
  for (std::size_t k = 1; k + 1 < height.size(); ++k)
    if (height[k] > height[k - 1] && height[k] >= height[k + 1]) peaks.push_back(height[k]);
  REQUIRE(peaks.size() >= 4);
  const auto place = to_host(model.contacts[0].arrays.place);
  const auto segment = to_host(model.contacts[0].arrays.tracked);
  double dashpots = 0;
  for (int s = 0; s < 4; ++s) {
    double inverse = 1 / corner;
    for (int k = 0; k < 4; ++k) {
      const double shape = segment_shape(k, place(s, 0), place(s, 1));
      inverse +=
          shape * shape / model.mass[model.contacts[0].master_nodes[model.contacts[0].master_segments[segment(s)][k]]];
    }
    dashpots += 2 * share * std::sqrt(stiffness / inverse);
  }
  const double zeta = dashpots / (2 * std::sqrt(sum * mass));
  // Peak-to-peak falls of the decaying swing are free of where it comes to rest.
  const double fall = std::log((peaks[0] - peaks[1]) / (peaks[2] - peaks[3])) / 2;
  const double exact = 2 * M_PI * zeta / std::sqrt(1 - zeta * zeta);
  INFO("logarithmic decrement " << fall << ", exact " << exact << ", share of critical of the whole cube " << zeta);
  CHECK_THAT(fall, WithinRel(exact, 0.03));
}

TEST_CASE("with growth and damping the element, eigenvalue and global steps keep pressed columns calm") {
  for (scene::StepEstimate estimate :
       {scene::StepEstimate::element, scene::StepEstimate::eigenvalue, scene::StepEstimate::global})
    for (double friction : {0.0, 0.3}) {
      TwoBlocks blocks;
      blocks.upper_size = blocks.lower_size = {2e-3, 2e-3, 4e-3};
      blocks.upper_divisions = blocks.lower_divisions = {2, 2, 4};
      blocks.friction = friction;
      scene::Scene scene = blocks.scene(1e-3);
      for (scene::Part& part : scene.parts) set_hourglass(part, scene::HourglassType::stiffness, 0.05);
      scene.gravity = {0, 0, -1e7};
      scene.contacts[0].damping = 0.4;
      scene.contacts[0].penalty_growth = {{0, 1}, {1e-7, 4}};
      scene.solver.step_estimate = estimate;
      // Heights know nothing of bodies few elements thick: see the changelog's known limits.
      scene.time.step_scale = estimate == scene::StepEstimate::element ? 0.8 : 0.99;
      hold(scene, "lower.z_min", {true, true, true});
      hold(scene, "upper.z_max", {true, true, false});  // without friction it would slide off
      scene.settle.active = true;
      Model model;
      build_model(scene, model);
      REQUIRE(settle_whole(model).settled);
      scene::Scene plain = scene;
      plain.contacts[0].damping = 0;
      plain.contacts[0].penalty_growth.clear();
      Model without;
      build_model(plain, without);
      INFO("estimate " << static_cast<int>(estimate) << ", step " << model.step_size << " s, of a plain law "
                       << without.step_size << " s");
      CHECK(model.step_size < 0.95 * without.step_size);
      std::mt19937 generator(3);
      std::uniform_real_distribution<double> speed(-1e-4, 1e-4);
      set_velocity(model, [&](const Vec3& x, int) { return Vec3{0, 0, x[2] < -3.9e-3 ? 0 : speed(generator)}; });
      // What settling has left swings on; a step too long makes it grow without end. Energies are means over some fifty
      // swings of the columns: the largest speed is a matter of chance.
      const int half = 4000, between = 20;
      double early = 0, late = 0;
      march(model, 2 * half, [&] {
        if (model.step % between != 0) return;
        const double kinetic = account_energies(model, model.step_size).kinetic;
        (model.step < half ? early : late) += std::isfinite(kinetic) ? kinetic * between / half : 1e300;
      });
      INFO("mean kinetic energy " << early << " J early, " << late << " late");
      CHECK(early < 0.5 * mass_of(model, "upper"));
      CHECK(late < 1.1 * early);
    }
}
