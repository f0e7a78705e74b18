#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <string>

#include "solve/launch_graph.hpp"
#include "solve/plan.hpp"
#include "solve/time_loop.hpp"
#include "tests/solve/moved_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// @param graphs value of RAILWAVE_STEP_GRAPHS
/// @param parts value of RAILWAVE_STEP_PARTS
End end_with(const scene::Scene& scene, const std::string& graphs, const char* parts = "1") {
  setenv("RAILWAVE_STEP_GRAPHS", graphs.c_str(), 1);
  setenv("RAILWAVE_STEP_PARTS", parts, 1);
  Model model;
  build_model(scene, model);
  run(model, {});
  unsetenv("RAILWAVE_STEP_GRAPHS");
  unsetenv("RAILWAVE_STEP_PARTS");
  return end_of(model);
}

void recorded_as_plain(const scene::Scene& scene) {
  const End plain = end_with(scene, "0");
  REQUIRE(plain.steps > 150);
  for (const char* parts : {"1", "2"})
    for (const char* graphs : {"1", "4", "16"}) {
      INFO("graphs of " << graphs << " steps, elements in " << parts << " parts");
      const End recorded = end_with(scene, graphs, parts);
      CHECK(recorded.steps == plain.steps);
      CHECK(recorded.position == plain.position);
      CHECK(recorded.velocity == plain.velocity);
    }
}

}  // namespace

TEST_CASE("stages of a step come one after the other") {
  scene::Scene scene = moved_blocks();
  SECTION("penalty") {}
  SECTION("multipliers on whose nodes no load acts") {
    scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
    scene.loads.pop_back();
  }
  SECTION("motions prescribed of loaded nodes and of others, beside multipliers") { scene = driven_apart(scene); }
  SECTION("multipliers") { scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier; }
  Model model;
  build_model(scene, model);
  const StepPlans plans(model);
  for (StepKind kind : {StepKind::advancing, StepKind::sampled}) {
    Stage last = Stage::begin;
    for (const auto* tasks : {&plans.of(kind).forces, &plans.of(kind).motion})
      for (const Task& task : *tasks) {
        INFO(task.name);
        CHECK(task.stage >= last);
        last = task.stage;
      }
  }
}

TEST_CASE("recorded steps are plain ones, bit for bit") {
  if (!has_launch_graphs) SKIP("Kokkos records no launches here");
  scene::Scene scene = moved_blocks();
  SECTION("double") {}
  SECTION("mixed") { scene.solver.precision = scene::Precision::mixed; }
  SECTION("single") {
    scene.parts[1].stiffness_damping = 0;
    scene.prescribed_motions.clear();
    scene.solver.precision = scene::Precision::single_precision;
  }
  SECTION("subcycling") {
    scene = on_coarse_block(scene);
    SECTION("penalty") {}
    SECTION("multipliers") { scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier; }
    Model model;
    build_model(scene, model);
    REQUIRE(model.subcycling.levels > 1);
  }
  SECTION("multipliers on whose nodes no load acts") {
    scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
    scene.loads.pop_back();
  }
  SECTION("motions prescribed of loaded nodes and of others, beside multipliers") { scene = driven_apart(scene); }
  SECTION("multipliers") { scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier; }
  SECTION("two contacts by multipliers") {
    scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
    scene.contacts.push_back(scene.contacts[0]);
    scene.contacts[1].name = "sides";
    scene.contacts[1].slave = "upper.x_max";
  }
  recorded_as_plain(scene);
}

TEST_CASE("nodes that wait for neither ties nor non-reflecting ends move beside them, as in plain steps") {
  if (!has_launch_graphs) SKIP("Kokkos records no launches here");
  TiedBlocks blocks;
  SECTION("double") {}
  SECTION("single") { blocks.precision = scene::Precision::single_precision; }
  scene::Scene scene = tied_and_open(blocks);
  SECTION("no load on the tied nodes") { scene.loads.pop_back(); }
  Model model;
  build_model(scene, model);
  REQUIRE(model.early_shared > 0);
  REQUIRE(model.early_shared < static_cast<int>(model.shared.nodes.extent(0)));
  recorded_as_plain(scene);
}

TEST_CASE("recorded steps renew the frames of elements in single precision when plain ones do") {
  if (!has_launch_graphs) SKIP("Kokkos records no launches here");
  scene::Scene scene = TwoBlocks{}.scene(3e-4);
  scene.contacts.clear();
  scene.parts[0].position[2] += 0.01;
  add_motion(scene, {"upper", "lower"}, {30, 0, 0}, {0, 0, 500});
  SECTION("mixed") { scene.solver.precision = scene::Precision::mixed; }
  SECTION("mixed, with subcycling") {
    scene.solver.precision = scene::Precision::mixed;
    scene.solver.subcycling = true;
  }
  SECTION("single") { scene.solver.precision = scene::Precision::single_precision; }
  recorded_as_plain(scene);
}
