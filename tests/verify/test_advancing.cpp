#include <catch2/catch_test_macros.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// Positions and velocities after a number of steps at which blocks may move their own nodes, or may not.
std::vector<double> outcome(const scene::Scene& scene, long steps, bool advancing) {
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  StepPlans plans(model);
  Instant instant;
  instant.step = model.step_size;
  for (long k = 0; k < steps; ++k) {
    instant.time = model.time = static_cast<double>(model.step) * model.step_size;
    // Now and then a step is sampled.
    plans.compute_forces(instant, advancing && k % 7 != 0 ? StepKind::advancing : StepKind::sampled);
    plans.advance(instant);
    instant.elapsed = model.step_size;
  }
  plans.compute_forces(instant, StepKind::sampled);
  std::vector<double> values;
  for (NodeField field : {NodeField::position, NodeField::velocity}) {
    const auto part = node_field(model, model.ties, field, all_nodes(model)).values;
    values.insert(values.end(), part.begin(), part.end());
  }
  const EnergyAccount energy = account_energies(model, model.step_size);
  values.insert(values.end(),
                {energy.contact, energy.friction, energy.hourglass, energy.external_work, energy.damping});
  return values;
}

}  // namespace

TEST_CASE("nodes that blocks advance at once move as all others do, bit by bit") {
  TwoBlocks blocks;
  blocks.upper_size = {0.02, 0.02, 0.02};
  blocks.upper_divisions = {9, 8, 9};
  blocks.lower_size = {0.04, 0.03, 0.02};
  blocks.lower_divisions = {16, 11, 9};
  blocks.friction = 0.3;
  blocks.gap = 1e-6;
  scene::Scene scene = blocks.scene(1e-4);
  hold(scene, "lower.z_min", {true, true, true});
  add_motion(scene, {"upper"}, {3, 1, -2});
  add_torque(scene, "upper.z_max", 40, {0, 1, 0});
  add_spring(scene, "ground", "upper.z_max", {1e6, 2e6, 3e6}, {10, 20, 30});
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness})
    for (auto precision :
         {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
      for (scene::Part& part : scene.parts) set_hourglass(part, hourglass, 0.1);
      scene.solver.precision = precision;
      const auto plain = outcome(scene, 200, false), advanced = outcome(scene, 200, true);
      std::size_t different = 0;
      for (std::size_t k = 0; k < plain.size(); ++k) different += !(plain[k] == advanced[k]);
      INFO("precision " << static_cast<int>(precision) << ", hourglass control " << static_cast<int>(hourglass)
                        << ": values that differ: " << different << " of " << plain.size());
      CHECK(different == 0);
    }
}
