#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <utility>

#include "solve/plan.hpp"
#include "solve/statics/settle.hpp"
#include "tests/solve/moved_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

constexpr const char* parts_variable = "RAILWAVE_STEP_PARTS";

Model model_in_parts(const scene::Scene& scene, const char* parts) {
  Model model;
  setenv(parts_variable, parts, 1);
  build_model(scene, model);
  unsetenv(parts_variable);
  set_initial_motion(model, model.nodes, model.beams);
  return model;
}

bool of_elements(const Task& task) { return task.stage == Stage::own_forces && task.lane >= OwnForceLanes::elements; }

/// Tasks of a step, and the model's clock then.
struct Due {
  std::vector<Task> tasks;
  Instant instant;
  long step = 0;
  double velocity_lag = 0;

  void run(Model& model) const {
    const long step_now = std::exchange(model.step, step);
    const double lag_now = std::exchange(model.velocity_lag, velocity_lag);
    run_tasks(tasks, instant, step);
    model.step = step_now;
    model.velocity_lag = lag_now;
  }
};

constexpr int steps = 120;

/// Runs steps by a plan.
/// @param step_tasks runs those of one
template <class StepTasks>
End after_steps(Model& model, const StepTasks& step_tasks) {
  StepPlans plans(model);
  const Plan& plan = plans.of(StepKind::advancing);
  std::vector<Task> all = plan.forces;
  append(all, plan.motion);
  const double step = model.step_size;
  for (int s = 0; s < steps; ++s) {
    const Instant instant{s * step, step, s == 0 ? 0 : step};
    model.time = instant.time;
    step_tasks(Due{all, instant, model.step, model.velocity_lag});
    plans.advance_clock(instant);
  }
  return end_of(model);
}

End in_order(Model& model) {
  return after_steps(model, [&](const Due& all) { all.run(model); });
}

/// Those of a step's tasks that have not been taken yet, by kind.
class Rest {
 public:
  explicit Rest(const Due& all) : all_(all), left_(all.tasks.size()) {}

  template <class Wanted>
  Due take(const Wanted& wanted) {
    Due some = all_;
    some.tasks.clear();
    for (const Task& task : all_.tasks)
      if (wanted(task)) some.tasks.push_back(task);
    left_ -= some.tasks.size();
    return some;
  }

  bool empty() const { return left_ == 0; }

 private:
  const Due& all_;
  std::size_t left_;
};

/// All but elements as early as what it waits for allows: loads and contact of a step before the second part of the
/// elements of the step before, and before the nodes that these move.
End elements_last(Model& model) {
  Due left;
  return after_steps(model, [&](const Due& all) {
    Rest rest(all);
    const auto first = [](const Task& task) { return task.part == 0 && !task.apart(); };
    const Due frames = rest.take([](const Task& task) { return task.stage < Stage::own_forces; });
    if (!frames.tasks.empty()) left.run(model);
    frames.run(model);
    rest.take([](const Task& task) { return task.stage == Stage::own_forces && !of_elements(task); }).run(model);
    if (frames.tasks.empty()) left.run(model);
    rest.take([&](const Task& task) { return of_elements(task) && first(task); }).run(model);
    rest.take([&](const Task& task) { return task.stage > Stage::own_forces && first(task); }).run(model);
    left = rest.take([&](const Task& task) { return !first(task); });
    REQUIRE(rest.empty());
    if (all.step == steps - 1) left.run(model);
  });
}

/// Tasks after the forces of elements, the last lanes of each stage first.
Due last_lanes_first(Due due) {
  std::stable_sort(due.tasks.begin(), due.tasks.end(), [](const Task& one, const Task& other) {
    return one.stage != other.stage ? one.stage < other.stage : one.lane > other.lane;
  });
  return due;
}

/// Loads as late as is allowed: after ties, multipliers and prescribed motions on whose nodes none act.
End loads_last(Model& model) {
  return after_steps(model, [&](const Due& all) {
    Rest rest(all);
    const auto beside = [](const Task& task) { return task.begins == Begins::beside_loads; };
    const auto of_loads = [](const Task& task) {
      return task.stage == Stage::own_forces && task.lane < OwnForceLanes::contact;
    };
    const auto own = [](const Task& task) { return task.stage <= Stage::own_forces; };
    rest.take([&](const Task& task) { return own(task) && !of_loads(task); }).run(model);
    last_lanes_first(rest.take(beside)).run(model);
    rest.take(of_loads).run(model);
    last_lanes_first(rest.take([&](const Task& task) { return !own(task) && !beside(task); })).run(model);
    REQUIRE(rest.empty());
  });
}

bool any_beside_loads(Model& model) {
  const Plan plan = make_plan(model, StepKind::advancing);
  const auto beside = [](const Task& task) { return task.begins == Begins::beside_loads; };
  return std::any_of(plan.forces.begin(), plan.forces.end(), beside) ||
         std::any_of(plan.motion.begin(), plan.motion.end(), beside);
}

}  // namespace

TEST_CASE("all but elements may go on beside the second part of the elements, bit for bit") {
  TiedBlocks blocks;
  blocks.fine = {8, 8, 32};
  scene::Scene scene = tied_and_open(blocks);
  bool loaded = true;
  SECTION("ties and non-reflecting ends") {}
  SECTION("ties on which no load acts") {
    scene.loads.pop_back();
    loaded = false;
  }
  SECTION("in single precision") { scene.solver.precision = scene::Precision::single_precision; }
  SECTION("in mixed precision") { scene.solver.precision = scene::Precision::mixed; }
  SECTION("ends without ties") {
    scene.ties.clear();
    scene.loads.pop_back();
    add_dashpots(scene, "fine.z_min");
  }
  SECTION("contact by multipliers, prescribed motions, connectors") {
    scene = moved_blocks();
    for (auto& mesh : scene.meshes) mesh.box.divisions = {32, 8, 16};
    scene.parts[1].stiffness_damping = 0;
    scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
  }
  SECTION("multipliers on whose nodes no load acts") {
    scene = moved_blocks();
    for (auto& mesh : scene.meshes) mesh.box.divisions = {32, 8, 16};
    scene.parts[1].stiffness_damping = 0;
    scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
    scene.loads.pop_back();
    loaded = false;
  }
  SECTION("motions prescribed of loaded nodes and of others, beside multipliers") {
    scene = driven_apart(moved_blocks());
    for (auto& mesh : scene.meshes) mesh.box.divisions = {32, 8, 40};
    scene.parts[1].stiffness_damping = 0;
    loaded = false;
  }
  SECTION("contact by springs") {
    scene = moved_blocks();
    for (auto& mesh : scene.meshes) mesh.box.divisions = {32, 8, 16};
    scene.parts[1].stiffness_damping = 0;
    scene.prescribed_motions.clear();
  }
  Model whole = model_in_parts(scene, "1"), divided = model_in_parts(scene, "2");
  REQUIRE(whole.parts.group < 0);
  REQUIRE(divided.parts.group >= 0);
  CHECK(divided.parts.blocks[0].extent(0) > 0);
  CHECK(divided.parts.blocks[1].extent(0) > 0);
  CHECK(any_beside_loads(whole) == !loaded);
  Model late = model_in_parts(scene, "2");
  const End expected = in_order(whole);
  for (const End& end : {elements_last(divided), loads_last(late)}) {
    CHECK(end.position == expected.position);
    CHECK(end.velocity == expected.velocity);
  }
}

TEST_CASE("plain nodes move the same way beside special ones as in a launch of their own, bit for bit") {
  scene::Scene scene = moved_blocks();
  SECTION("in double precision") {}
  SECTION("in mixed precision") { scene.solver.precision = scene::Precision::mixed; }
  SECTION("in single precision") {
    scene = tied_and_open({});
    scene.solver.precision = scene::Precision::single_precision;
  }
  SECTION("with multipliers") { scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier; }
  Model together = model_in_parts(scene, "1"), apart = model_in_parts(scene, "1");
  REQUIRE(together.shared.first_special > 0);
  REQUIRE(together.shared.special.extent(0) > 0);
  together.plain_apart = false;
  apart.plain_apart = true;
  CHECK(make_plan(apart, StepKind::advancing).motion.size() > make_plan(together, StepKind::advancing).motion.size());
  const End expected = in_order(together), end = in_order(apart);
  CHECK(end.position == expected.position);
  CHECK(end.velocity == expected.velocity);
}

TEST_CASE("elements come in one part where they are not one launch") {
  TiedBlocks blocks;
  blocks.fine = {8, 8, 32};
  scene::Scene scene = tied_and_open(blocks);
  SECTION("damping") {
    for (scene::Part& part : scene.parts) part.stiffness_damping = 1e-8;
  }
  SECTION("subcycling") {
    scene = on_coarse_block(moved_blocks());
    scene.parts[1].stiffness_damping = 0;
  }
  CHECK(model_in_parts(scene, "2").parts.group < 0);
}

TEST_CASE("what motions prescribed of a set wait for follows from its nodes, and from sets with some of them") {
  scene::Scene scene = moved_blocks();
  scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
  scene.constraints.clear();
  scene.loads.pop_back();
  const scene::PrescribedMotion pattern = scene.prescribed_motions[0];
  scene.prescribed_motions.clear();
  const auto add = [&](const std::string& target, int direction) {
    scene::PrescribedMotion& motion = scene.prescribed_motions.emplace_back(pattern);
    motion.name = motion.target = target;
    motion.directions = {false, false, false};
    motion.directions[direction] = true;
  };
  add("lower.x_min", 1);
  add("lower.x_max", 1);
  add("upper.z_max", 0);  // under load, far from the contact
  add("lower.z_min", 2);  // far from it, but it has nodes of the first two
  Model model;
  build_model(scene, model);
  const std::vector<PrescribedSet>& sets = model.prescribed;
  REQUIRE(sets.size() == 4);
  for (int set : {0, 1, 3}) {
    CHECK(sets[set].first_alike == 0);
    CHECK(sets[set].pushed);
    CHECK_FALSE(sets[set].loaded);
  }
  CHECK(sets[2].first_alike == 2);
  CHECK_FALSE(sets[2].pushed);
  CHECK(sets[2].loaded);
}
