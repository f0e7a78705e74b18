#include <catch2/catch_test_macros.hpp>
#include <functional>
#include <vector>

#include "solve/launch_graph.hpp"
#include "solve/monitor/account.hpp"
#include "solve/plan.hpp"
#include "solve/time_loop.hpp"
#include "tests/solve/moved_blocks.hpp"
#include "tests/solve/sample_numbers.hpp"
#include "tests/verify/beam_scene.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// A history every few steps, and fields now and then.
scene::Scene written_blocks() {
  scene::Scene scene = moved_blocks();
  scene.output.history_interval = scene.time.end / 40;
  scene.output.field_interval = scene.time.end / 3;
  scene.output.history_sets = {"upper.z_max"};
  scene.points = {massless("pole", {0.03, 0.03, 0.2})};
  scene.beams = {round_beam("pole", "upper.z_max", 0.004, 2)};
  return scene;
}

class Listening : public RunObserver {
 public:
  explicit Listening(bool looks_at_model) : looks_at_model_(looks_at_model) {}
  void history(const Model&, const HistorySample& sample) override { histories.push_back(numbers_of(sample)); }
  void fields(const Model& model, const HistorySample& sample, const DueFields&) override {
    CHECK(model.time == sample.time);
  }
  bool looks_at_model() const override { return looks_at_model_; }

  std::vector<std::vector<double>> histories;

 private:
  bool looks_at_model_;
};

struct Listened {
  std::vector<std::vector<double>> histories;
  RunSummary summary;
  End end;
};

Listened listen(const scene::Scene& scene, bool looks_at_model) {
  Listening observer(looks_at_model);
  Model model;
  build_model(scene, model);
  const RunSummary summary = run(model, {&observer});
  return {observer.histories, summary, end_of(model)};
}

}  // namespace

TEST_CASE("a sample that is under way is of its own instant") {
  Model model;
  build_model(written_blocks(), model);
  REQUIRE(model.beams);
  set_initial_motion(model, model.nodes, model.beams);
  StepPlans plans(model);
  Instant instant;
  instant.step = model.step_size;
  Milestone done;
  for (int step = 0; step < 60; ++step) {
    instant.time = model.time = step * model.step_size;
    plans.compute_forces(instant, step % 20 == 10 ? StepKind::sampled : StepKind::advancing);
    if (step % 20 == 10) {
      const std::vector<double> waited_for = numbers_of(take_sample(model, model.step_size));
      SampleUnderWay late(model, model.step_size, {});
      for (int more = 0; more < 3; ++more) {
        plans.advance(instant);
        if (more == 0) late.send(done);
        instant.elapsed = model.step_size;
        instant.time = model.time = ++step * model.step_size;
        plans.compute_forces(instant, StepKind::advancing);
      }
      CHECK(numbers_of(late.finish(done)) == waited_for);
    }
    plans.advance(instant);
    instant.elapsed = model.step_size;
  }
}

TEST_CASE("histories that come late are those that are waited for") {
  if (!has_launch_graphs) SKIP("the host waits for all histories here");
  scene::Scene scene = written_blocks();
  SECTION("penalty") {}
  SECTION("multipliers") { scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier; }
  SECTION("one each step") { scene.output.history_interval = 0; }
  SECTION("a step that is found anew") {
    scene.solver.step_estimate = scene::StepEstimate::global;
    scene.solver.renew_steps = 7;
  }
  SECTION("odd energies, of which the monitor warns") { scene.monitor.energy_error = 1e-14; }
  SECTION("what checks of the whole model warn of") {
    scene.monitor.speed = 0.05;
    scene.monitor.contact_edge = 1e-9;
  }
  const Listened waited = listen(scene, true), late = listen(scene, false);
  CHECK(late.histories == waited.histories);
  CHECK(late.histories.size() >= 40);
  CHECK(late.end.position == waited.end.position);
  CHECK(late.end.velocity == waited.end.velocity);
  CHECK(late.summary.warnings == waited.summary.warnings);
  CHECK(late.summary.account == waited.summary.account);
  CHECK(late.summary.worst_values == waited.summary.worst_values);
  CHECK(!late.summary.worst_values.empty());
}

TEST_CASE("a check of the whole model that comes late stops a run soon") {
  if (!has_launch_graphs) SKIP("the host waits for all checks here");
  scene::Scene scene = written_blocks();
  scene.monitor.speed = 0.05;
  scene.monitor.fatal_speed = 0.08;
  const Listened waited = listen(scene, true), late = listen(scene, false);
  REQUIRE(waited.summary.fault.has_value());
  REQUIRE(late.summary.fault.has_value());
  CHECK(late.summary.fault->kind == FaultKind::speed);
  CHECK(late.summary.fault->step == waited.summary.fault->step);
  CHECK(late.summary.fault->value == waited.summary.fault->value);
  CHECK(late.end.steps <= late.summary.fault->step + 33);
}

TEST_CASE("a history that comes late stops a run soon") {
  if (!has_launch_graphs) SKIP("the host waits for all histories here");
  scene::Scene scene = written_blocks();
  scene.monitor.energy_error = 1e-14;
  scene.monitor.fatal_energy_error = 1e-13;
  const Listened waited = listen(scene, true), late = listen(scene, false);
  REQUIRE(waited.summary.fault.has_value());
  REQUIRE(late.summary.fault.has_value());
  CHECK(late.summary.fault->step == waited.summary.fault->step);
  CHECK(late.end.steps >= late.summary.fault->step);
  CHECK(late.end.steps <= late.summary.fault->step + 33);
  CHECK(late.histories.back()[1] == static_cast<double>(late.end.steps));
}
