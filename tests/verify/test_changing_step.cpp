#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "solve/step_control.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// An upper block that leaves the lower one at once, on a mesh whose step the contact had shortened.
scene::Scene leaving_blocks() {
  TwoBlocks blocks;
  blocks.upper_size = blocks.lower_size = {3e-3, 3e-3, 3e-3};
  blocks.upper_divisions = blocks.lower_divisions = {3, 3, 3};
  scene::Scene scene = blocks.scene(4e-5);
  scene.contacts[0].penalty_scale = 5;
  add_motion(scene, {"upper"}, {0, 0, 50});
  scene.solver.step_estimate = scene::StepEstimate::global;
  scene.solver.renew_steps = 40;
  scene.output.history_interval = 1e-6;
  return scene;
}

}  // namespace

TEST_CASE("when contact ends the step grows, and the run keeps its times, its end and its energy") {
  const scene::Scene scene = leaving_blocks();
  Model model;
  build_model(scene, model);
  Recorder recorder;
  const RunSummary summary = run(model, {&recorder});
  REQUIRE(summary.completed);
  CHECK(summary.step_renewals >= 3);
  CHECK(summary.largest_step > 1.1 * summary.smallest_step);
  CHECK_THAT(summary.time, WithinRel(scene.time.end, 1e-12));

  // Each sample within a step of an interval after the one before, but for the last one, at the run's end.
  for (std::size_t k = 1; k + 1 < recorder.samples.size(); ++k)
    CHECK_THAT(recorder.samples[k].time - recorder.samples[k - 1].time, WithinAbs(1e-6, 1.01 * summary.largest_step));
  CHECK(recorder.samples.size() > 38);
  for (const HistorySample& sample : recorder.samples)
    CHECK_THAT(sample.energy.balance_error / recorder.samples[0].energy.kinetic, WithinAbs(0, 1e-6));
}

TEST_CASE("a global step that is renewed and stays gives the very run of a step that is never renewed") {
  std::vector<double> ends[2];
  long steps[2];
  for (int k : {0, 1}) {
    scene::Scene scene = block_scene({0.03, 0.02, 0.02}, {3, 2, 2}, 1e-4);
    scene.solver.step_estimate = scene::StepEstimate::global;
    scene.solver.renew_steps = k == 0 ? 0 : 7;
    Model model;
    build_model(scene, model);
    set_velocity(model, [](const Vec3& x, int) { return Vec3{std::sin(300 * x[0]), std::cos(200 * x[1]), x[2]}; });
    const RunSummary summary = run(model, {});
    CHECK(summary.smallest_step == summary.largest_step);
    CHECK((summary.step_renewals > 5) == (k == 1));
    ends[k] = node_field(model, model.ties, NodeField::position, all_nodes(model)).values;
    steps[k] = summary.steps;
  }
  CHECK(steps[0] == steps[1]);
  CHECK((ends[0] == ends[1]));
}

TEST_CASE("something due every so often keeps its times when the step changes") {
  EverySoOften output(1e-6, 1e-7);
  CHECK(output.due(0));
  CHECK_FALSE(output.due(9));
  CHECK(output.due(10));
  // At step 14, t = 1.4 us, the step is halved: 0.6 us are left to the next output.
  output.step_changed(14, 1e-7, 5e-8);
  CHECK_FALSE(output.due(20));
  CHECK(output.due(26));
  CHECK_FALSE(output.due(36));
  CHECK(output.due(46));
  // On an output's own step: that one stays, the next one is a whole interval away.
  output.step_changed(46, 5e-8, 1e-7);
  CHECK(output.due(46));
  CHECK(output.due(56));
  CHECK_FALSE(output.due(55));

  EverySoOften each(0, 1e-7);
  CHECK(each.due(3));
  each.step_changed(3, 1e-7, 2e-7);
  CHECK(each.due(4));
  CHECK(each.due(5));
}
