#include <fmt/format.h>
#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <iostream>

#include "case/read_case.hpp"
#include "solve/monitor/diagnosis.hpp"
#include "source_folder.hpp"
#include "tests/monitor/seeded.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// What a run's monitor said, and when things had gone wrong.
struct Witness : RunObserver {
  std::vector<Fault> warnings;
  long first_warning = -1, last_good = 0, odd_since = -1;
  RunSummary summary;

  void warning(const Model& model, const Fault& fault) override {
    warnings.push_back(fault);
    if (first_warning < 0) first_warning = model.step;
  }
  /// A hundredth of what the run was given is no rounding.
  void progress(const Model& model, const HistorySample& sample) override {
    given =
        std::max({given, std::fabs(sample.energy.external_work), sample.energy.kinetic - sample.energy.balance_error});
    const bool good =
        std::isfinite(sample.energy.balance_error) && std::fabs(sample.energy.balance_error) <= 0.01 * given;
    if (good) last_good = model.step;
    odd_since = good ? -1 : last_good;
  }
  void end(const Model&, const RunSummary& ended) override { summary = ended; }
  double given = 0;
};

constexpr long steps = 40000;

struct Outcome {
  std::string text, cause;
  double wasted =
      0;  ///< share of the run between the last good check and the stop, or the first warning where it goes on
  Witness witness;
};

Outcome outcome_of(const Seed& seed, long limit = steps) {
  Model model;
  // What is spoiled is the step of the elements, which no contact makes another one.
  scene::Scene scene = seed.scene;
  scene.solver.step_estimate = scene::StepEstimate::element;
  if (seed.mesh) {
    Assembly assembly = assemble(scene);
    seed.mesh(assembly);
    build_model(scene, assembly, model);
  } else {
    build_model(scene, model);
  }
  if (seed.spoil) seed.spoil(model);
  model.step_count = limit;
  model.scene.time.end = static_cast<double>(limit) * model.step_size;  // of a step that follows elements too
  model.output_times.history = model.output_times.fields = 1e9 * model.step_size;
  Outcome outcome;
  run(model, {&outcome.witness});
  const RunSummary& summary = outcome.witness.summary;
  if (const Fault* fault = summary.fault                      ? &*summary.fault
                           : outcome.witness.warnings.empty() ? nullptr
                                                              : &outcome.witness.warnings.front()) {
    outcome.text = fault->summary();
    outcome.cause = fault->causes.at(0).name;
  }
  const long until = summary.fault ? summary.steps : outcome.witness.first_warning;
  outcome.wasted =
      outcome.witness.odd_since < 0
          ? 0
          : static_cast<double>(std::max(0L, until - outcome.witness.odd_since)) / static_cast<double>(limit);
  return outcome;
}

}  // namespace

TEST_CASE(
    "twenty seeded instabilities are all named with the true cause first and before a twentieth of the run is wasted",
    "[table]") {
  // What docs/monitor.md shows.
  std::cout << "| seeded | named first | run until step | wasted |\n|---|---|---|---|\n";
  int named = 0, right = 0, timely = 0, count = 0;
  for (const Seed& seed : seeds()) {
    ++count;
    const Outcome outcome = outcome_of(seed, seed.cause == "unheld" || seed.cause == "soft penalty" ? 20000 : steps);
    const std::string& text = outcome.text;
    const auto at = text.find("likely cause: ");
    const bool is_named = !text.empty() && at != std::string::npos;
    const std::string cause = outcome.cause;
    named += is_named;
    right += cause == seed.cause;
    std::cout << fmt::format("| {} | {} | {} | {:.3f} % |\n", seed.what, cause, outcome.witness.summary.steps,
                             100 * outcome.wasted)
              << std::flush;
    INFO(seed.what << ": " << text);
    CHECK(is_named);
    timely += outcome.wasted < 0.05;
  }
  CHECK(count == 20);
  CHECK(named == count);
  CHECK(right == count);
  CHECK(timely == count);
}

namespace {

/// With loads that grow over the given time, s.
scene::Scene ramped(scene::Scene scene, double duration) {
  add_ramp(scene, "ramp", 0, duration);
  for (scene::Load& load : scene.loads) load.curve = "ramp";
  return scene;
}

/// All that the monitor says of a scene.
std::string said_of(scene::Scene scene, double end) {
  scene.time.end = end;
  scene.output.history_interval = end / 20;
  scene.output.field_interval = end;
  Model model;
  build_model(scene, model);
  Witness witness;
  run(model, {&witness});
  std::string said;
  for (const Fault& fault : witness.warnings) said += fault.summary() + '\n';
  if (!witness.summary.completed) said += "ended: " + witness.summary.reason;
  return said;
}

}  // namespace

TEST_CASE("sound scenes bring no warning") {
  CHECK(said_of(ramped(pressed_block(), 2e-4), 2e-3) == "");
  CHECK(said_of(ramped(sprung_mass(1e8, 100), 2e-4), 2e-3) == "");
  CHECK(said_of(ramped(bent_beam(), 2e-3), 2e-2) == "");
  TwoBlocks sliding;
  sliding.upper_divisions = {4, 4, 2};
  sliding.lower_divisions = {8, 8, 3};
  sliding.friction = 0.3;
  for (const auto algorithm : both_algorithms) {
    sliding.algorithm = algorithm;
    scene::Scene scene = sliding.scene(1);
    hold(scene, "lower.z_min", {true, true, true});
    // Under the upper block's edges viscous control would take a seventh of the elastic energy.
    for (scene::Part& part : scene.parts) part.take_hourglass(scene::HourglassType::stiffness);
    add_pressure(scene, "upper.z_max", 1e6);
    scene = ramped(scene, 2e-4);
    add_motion(scene, {"upper"}, {1, 0, 0});
    INFO(name_of(algorithm));
    CHECK(said_of(scene, 1e-3) == "");
  }
}

TEST_CASE("an inactive monitor stops a run that is no longer finite and says nothing else") {
  std::vector<Seed> all = seeds();
  Seed& seed = all[1];
  seed.scene.monitor.active = false;
  const Outcome outcome = outcome_of(seed);
  REQUIRE(outcome.witness.summary.fault);
  CHECK(outcome.witness.summary.fault->kind == FaultKind::not_finite);
  CHECK(outcome.witness.warnings.size() == 1);
  CHECK(!outcome.witness.summary.completed);
}

TEST_CASE("a limit that is set is the one that counts") {
  scene::Scene scene = pressed_block();
  scene.monitor.speed = 1e-6;
  const std::string said = said_of(scene, 2e-4);
  CHECK(said.find("limit 1e-06") != std::string::npos);
}

TEST_CASE("a step that the global estimate allows is not said to be beyond what it is made of") {
  const auto check = [](scene::Scene scene, const std::string& name, double StableStep::*own) {
    scene.solver.step_estimate = scene::StepEstimate::global;
    Model model;
    build_model(scene, model);
    const auto causes = [&](double step) {
      model.step_size = step;
      return steps_too_long(model, model, model.connectors.cells, model.contacts);
    };
    INFO(name);
    REQUIRE(model.stable_step.global > model.stable_step.*own);
    CHECK(causes(0.99 * model.stable_step.global).empty());
    const auto beyond = causes(1.01 * model.stable_step.global);
    CHECK(std::any_of(beyond.begin(), beyond.end(), [&](const Cause& cause) { return cause.name == name; }));
  };
  check(pressed_blocks(20), "step beyond contact springs", &StableStep::contact);
  // Damped, so that elements count with their eigenvalues: each alone is stiffer than all together.
  scene::Scene cubes = block_scene({0.03, 0.03, 0.02}, {5, 5, 3}, 1);
  cubes.parts[0].take_hourglass(scene::HourglassType::stiffness);
  cubes.parts[0].mass_damping = 3000;
  check(cubes, "step beyond elements", &StableStep::elements);
}
