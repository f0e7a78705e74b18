#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <memory>
#include <stdexcept>
#include <vector>

#include "solve/time_loop.hpp"
#include "tests/solve/moved_blocks.hpp"
#include "tests/solve/sample_numbers.hpp"
#include "tests/verify/beam_scene.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// All numbers of each history, and where the nodes are at each output of fields.
struct Samples : RunObserver {
  std::vector<std::vector<double>> histories;
  std::vector<End> fields_of;
  void history(const Model&, const HistorySample& sample) override { histories.push_back(numbers_of(sample)); }
  void fields(const Model& model, const HistorySample& /*sample*/, const DueFields& /*due*/) override {
    fields_of.push_back(end_of(model));
  }
};

/// How many steps another member has taken when this one begins.
struct StepsAhead : RunObserver {
  explicit StepsAhead(const Model& the_other) : other(the_other) {}
  const Model& other;
  long steps = -1;
  void history(const Model&, const HistorySample&) override {
    if (steps < 0) steps = other.step;
  }
};

/// A disk that is full from the second sample on.
struct FullDisk : RunObserver {
  int samples = 0;
  void history(const Model&, const HistorySample&) override {
    if (++samples > 1) throw std::runtime_error("no space left");
  }
};

/// Scenes that differ in numbers, in steps, in how contact is found, in precision, and in what a step computes.
std::vector<scene::Scene> variants() {
  scene::Scene scene = moved_blocks();
  scene.output.history_interval = scene.time.end / 60;
  scene.output.field_interval = scene.time.end / 3;
  scene.output.history_sets = {"upper.z_max"};
  std::vector<scene::Scene> scenes(8, scene);
  scenes[1].contacts[0].friction = 0.1;
  scenes[1].contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
  scenes[2].time.end *= 0.5;
  scenes[2].materials[0].youngs_modulus *= 2;
  scenes[3].solver.precision = scene::Precision::mixed;
  scenes[4].solver.precision = scene::Precision::single_precision;
  scenes[4].prescribed_motions.clear();
  scenes[4].points = {massless("pole", {0.03, 0.03, 0.2})};
  scenes[4].beams = {round_beam("pole", "upper.z_max", 0.004, 2)};
  scenes[5].parts[0].stiffness_damping = 1e-8;
  scenes[6] = tied_and_open({});
  scenes[6].output.history_interval = scenes[6].time.end / 30;
  scenes[7].solver.step_estimate = scene::StepEstimate::global;
  scenes[7].solver.renew_steps = 50;
  return scenes;
}

}  // namespace

TEST_CASE("members of an ensemble are what they are alone, bit for bit") {
  const std::vector<scene::Scene> scenes = variants();
  std::vector<std::unique_ptr<Model>> models;
  std::vector<Samples> samples(scenes.size());
  std::vector<EnsembleMember> members;
  for (std::size_t m = 0; m < scenes.size(); ++m) {
    models.push_back(std::make_unique<Model>());
    build_model(scenes[m], *models[m]);
    members.push_back({models[m].get(), {&samples[m]}});
  }
  const std::vector<RunOutcome> outcomes = run_together(members);
  for (std::size_t m = 0; m < scenes.size(); ++m) {
    INFO("member " << m);
    REQUIRE(outcomes[m].summary);
    CHECK(outcomes[m].summary->completed);
    Model alone;
    build_model(scenes[m], alone);
    Samples of_alone;
    const RunSummary alone_summary = run(alone, {&of_alone});
    const End expected = end_of(alone), end = end_of(*models[m]);
    CHECK(end.steps == expected.steps);
    if (m == 0) CHECK(end.steps > 256);  // contacts' ends are checked at such steps
    CHECK(end.position == expected.position);
    CHECK(end.velocity == expected.velocity);
    CHECK(samples[m].histories == of_alone.histories);
    REQUIRE(samples[m].fields_of.size() == of_alone.fields_of.size());
    for (std::size_t k = 0; k < of_alone.fields_of.size(); ++k) {
      CHECK(samples[m].fields_of[k].position == of_alone.fields_of[k].position);
      CHECK(samples[m].fields_of[k].velocity == of_alone.fields_of[k].velocity);
    }
    CHECK(outcomes[m].summary->warnings == alone_summary.warnings);
  }
}

TEST_CASE("a member that fails or breaks down ends no other") {
  scene::Scene scene = moved_blocks();
  scene.time.end *= 0.2;
  std::vector<std::unique_ptr<Model>> models;
  std::vector<EnsembleMember> members;
  FullDisk full;
  for (std::size_t m = 0; m < 3; ++m) {
    models.push_back(std::make_unique<Model>());
    build_model(scene, *models[m]);
    members.push_back({models[m].get(), {}});
  }
  Kokkos::deep_copy(models[1]->nodes.velocity, 1e300);  // nothing is finite soon
  members[0].observers = {&full};
  const std::vector<RunOutcome> outcomes = run_together(members);
  CHECK(!outcomes[0].summary);
  CHECK_THAT(outcomes[0].error, Catch::Matchers::ContainsSubstring("no space left"));
  REQUIRE(outcomes[1].summary);
  CHECK(!outcomes[1].summary->completed);
  CHECK(outcomes[1].summary->fault);
  REQUIRE(outcomes[2].summary);
  CHECK(outcomes[2].summary->completed);
}

TEST_CASE("members are not all at the same step, so that they do not search for one at the same time") {
  std::vector<std::unique_ptr<Model>> models;
  std::vector<EnsembleMember> members;
  for (std::size_t m = 0; m < 2; ++m) {
    models.push_back(std::make_unique<Model>());
    build_model(moved_blocks(), *models[m]);
    members.push_back({models[m].get(), {}});
  }
  StepsAhead first_when_second_begins(*models[0]), second_when_first_begins(*models[1]);
  members[0].observers = {&second_when_first_begins};
  members[1].observers = {&first_when_second_begins};
  const long sixteenth = models[0]->step_count / 16;
  REQUIRE(sixteenth > 8);
  for (const RunOutcome& outcome : run_together(members)) CHECK(outcome.summary->completed);
  CHECK(second_when_first_begins.steps == 0);
  CHECK(first_when_second_begins.steps >= std::min(160L, sixteenth));
}
