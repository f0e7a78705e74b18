#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <memory>
#include <stdexcept>
#include <vector>

#include "solve/time_loop.hpp"
#include "tests/solve/moved_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// Energies of each sample.
struct Samples : RunObserver {
  std::vector<double> kinetic;
  void history(const Model&, const HistorySample& sample) override { kinetic.push_back(sample.energy.kinetic); }
};

/// A disk that is full from the second sample on.
struct FullDisk : RunObserver {
  int samples = 0;
  void history(const Model&, const HistorySample&) override {
    if (++samples > 1) throw std::runtime_error("no space left");
  }
};

/// Scenes that differ in numbers, in steps and in how contact is found.
std::vector<scene::Scene> variants() {
  scene::Scene scene = moved_blocks();
  scene.time.end *= 0.4;
  std::vector<scene::Scene> scenes(3, scene);
  scenes[1].contacts[0].friction = 0.1;
  scenes[1].contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
  scenes[2].time.end *= 0.5;
  scenes[2].materials[0].youngs_modulus *= 2;
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
    run(alone, {&of_alone});
    const End expected = end_of(alone), end = end_of(*models[m]);
    CHECK(end.steps == expected.steps);
    CHECK(end.position == expected.position);
    CHECK(end.velocity == expected.velocity);
    CHECK(samples[m].kinetic == of_alone.kinetic);
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
