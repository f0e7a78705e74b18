#include <Kokkos_Core.hpp>
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "solve/plan.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// What a profiler sees: regions and the kernels launched in them. Kokkos' callbacks are functions without a place for
/// data of ours.
struct Seen {
  std::vector<std::string> regions;
  std::map<std::string, int> kernels;  ///< by region
  std::string within;
};
Seen seen;

void push_region(const char* name) {
  seen.within = name;
  seen.regions.emplace_back(name);
}
void pop_region() { seen.within.clear(); }
void begin_kernel(const char* /*name*/, std::uint32_t /*device*/, std::uint64_t* /*kernel*/) {
  ++seen.kernels[seen.within];
}
void begin_copy(Kokkos_Profiling_SpaceHandle, const char* /*to*/, const void*, Kokkos_Profiling_SpaceHandle,
                const char* /*from*/, const void*, std::uint64_t) {
  ++seen.kernels[seen.within];
}

/// Sees until its end.
class Profiler {
 public:
  Profiler() : before_(Kokkos::Tools::Experimental::get_callbacks()) {
    using namespace Kokkos::Tools::Experimental;
    seen = {};
    set_push_region_callback(push_region);
    set_pop_region_callback(pop_region);
    set_begin_parallel_for_callback(begin_kernel);
    set_begin_parallel_reduce_callback(begin_kernel);
    set_begin_parallel_scan_callback(begin_kernel);
    set_begin_deep_copy_callback(begin_copy);
  }
  ~Profiler() { Kokkos::Tools::Experimental::set_callbacks(before_); }
  Profiler(const Profiler&) = delete;
  Profiler& operator=(const Profiler&) = delete;

 private:
  Kokkos::Tools::Experimental::EventSet before_;
};

std::vector<std::string> due_names(const Plan& plan, long step) {
  std::vector<std::string> names;
  for (const auto* tasks : {&plan.forces, &plan.motion})
    for (const Task& task : *tasks)
      if (task.due(step)) names.push_back(task.name);
  return names;
}

/// Every 16th step of 64 is sampled. Each step's regions must be its plan's tasks, and no kernel lies beside them.
void check_what_a_profiler_sees(const scene::Scene& scene) {
  Model model;
  build_model(scene, model);
  StepPlans plans(model);
  Instant instant;
  instant.step = model.step_size;
  const Profiler profiler;
  for (long k = 0; k < 64; ++k) {
    instant.time = model.time = static_cast<double>(k) * model.step_size;
    const StepKind kind = k % 16 == 0 ? StepKind::sampled : StepKind::advancing;
    const auto expected = due_names(plans.of(kind), model.step);
    seen.regions.clear();
    plans.compute_forces(instant, kind);
    plans.advance(instant);
    instant.elapsed = model.step_size;
    REQUIRE(seen.regions == expected);
  }
  INFO("kernels beside all tasks: " << seen.kernels[""]);
  CHECK(seen.kernels[""] == 0);
  for (StepKind kind : {StepKind::advancing, StepKind::sampled})
    for (const std::string& name : due_names(plans.of(kind), 0)) {
      INFO("task " << name);
      CHECK(seen.kernels[name] > 0);
    }
}

bool has(const Plan& plan, const std::string& name) {
  const auto names = due_names(plan, 0);
  return std::any_of(names.begin(), names.end(), [&](const auto& n) { return n.find(name) != std::string::npos; });
}

}  // namespace

TEST_CASE("a profiler sees the tasks of the plans, and nothing beside them") {
  scene::Scene scene = busy_blocks();
  SECTION("double") {}
  SECTION("mixed") { scene.solver.precision = scene::Precision::mixed; }
  SECTION("single") {
    scene.parts[1].stiffness_damping = 0;
    scene.solver.precision = scene::Precision::single_precision;
  }
  SECTION("multipliers") { scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier; }
  SECTION("smooth normals, on a device not in one launch with the elements") {
    scene.contacts[0].normals = scene::ContactNormals::smooth;
  }
  SECTION("two contacts") {
    scene.contacts.push_back(scene.contacts[0]);
    scene.contacts[1].name = "sides";
    scene.contacts[1].slave = "upper.x_min";
  }
  check_what_a_profiler_sees(scene);
}

TEST_CASE("a profiler sees the tasks that are due with subcycling") {
  TwoBlocks blocks;
  blocks.lower_size = {0.3, 0.3, 0.2};
  blocks.lower_divisions = {10, 10, 7};
  blocks.upper_divisions = {16, 16, 4};
  scene::Scene scene = busy_blocks(blocks);
  scene.solver.subcycling = true;
  Model model;
  build_model(scene, model);
  REQUIRE(model.subcycling.levels > 1);
  check_what_a_profiler_sees(scene);
}

TEST_CASE("plans hold what the scene needs, and a fused launch is a task of its own") {
  scene::Scene scene = busy_blocks();
  scene.parts[1].stiffness_damping = 0;
  Model model;
  build_model(scene, model);
  const StepPlans plans(model);
  const Plan &advancing = plans.of(StepKind::advancing), &sampled = plans.of(StepKind::sampled);
  CHECK(has(advancing, "with their inner nodes"));
  CHECK_FALSE(has(sampled, "with their inner nodes"));
  CHECK(has(advancing, "nodes that element blocks share"));
  CHECK_FALSE(has(advancing, "clearing of contact forces"));
  CHECK(has(sampled, "clearing of contact forces"));
  CHECK(has(advancing, "contact touch and elements") == on_device);
  CHECK_FALSE(has(sampled, "contact touch and elements"));
  CHECK(has(advancing, "torques, gather of loads") == !on_device);
  for (const Plan* plan : {&advancing, &sampled}) {
    CHECK_FALSE(has(*plan, "damping"));
    CHECK_FALSE(has(*plan, "multipliers"));
    CHECK_FALSE(has(*plan, "forces of ties"));
    CHECK_FALSE(has(*plan, "beams"));
    for (const auto* tasks : {&plan->forces, &plan->motion})
      for (const Task& task : *tasks) CHECK_FALSE(task.step.empty());
  }
}
