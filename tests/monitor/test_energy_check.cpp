#include <fmt/format.h>
#include <catch2/catch_test_macros.hpp>

#include "tests/monitor/seeded.hpp"

using namespace railwave;
using namespace railwave::verify;

/// The check of the energy balance: what is done here to a run's state from outside stands for whatever defect makes or
/// loses energy.
namespace {

/// Changes a run's state at the first check from a step on, or at each, and remembers what the monitor said.
struct Meddler : RunObserver {
  Model* model = nullptr;
  bool again = false;
  long from = 0;
  std::function<void(Model&)> meddle;

  long done_at = -1;
  EnergyAccount before;
  std::vector<Fault> faults;
  RunSummary summary;

  void progress(const Model& /*model*/, const HistorySample& sample) override {
    if (!meddle || (done_at >= 0 && !again) || sample.step < from) return;
    if (done_at < 0) {
      done_at = sample.step;
      before = sample.energy;
    }
    meddle(*model);
  }
  void warning(const Model& /*model*/, const Fault& fault) override { faults.push_back(fault); }
  void end(const Model& /*model*/, const RunSummary& ended) override { summary = ended; }

  std::string said() const {
    std::string all;
    for (const Fault& fault : faults) all += fault.summary() + '\n';
    return all;
  }
};

/// 10.9 t at 100 km/h, which nothing touches: 4.2 MJ.
void add_traveller(scene::Scene& scene) {
  add_point(scene, "traveller", 10900, {0, 5, 0});
  add_motion(scene, {"traveller"}, {100 / 3.6, 0, 0});
}

/// A block on a held one, pressed on it within 0.1 ms.
scene::Scene pressed_pair(scene::ContactAlgorithm algorithm) {
  TwoBlocks blocks;
  blocks.upper_divisions = {4, 4, 2};
  blocks.lower_divisions = {8, 8, 3};
  blocks.algorithm = algorithm;
  scene::Scene scene = blocks.scene(1);
  for (scene::Part& part : scene.parts) part.take_hourglass(scene::HourglassType::stiffness);
  hold(scene, "lower.z_min", {true, true, true});
  add_pressure(scene, "upper.z_max", 1e7, "ramp");
  add_ramp(scene, "ramp", 0, 1e-4);
  add_traveller(scene);
  scene.solver.step_estimate = scene::StepEstimate::element;  // runs are so many steps of it
  return scene;
}

constexpr long steps = 4000;

Meddler run_with(scene::Scene scene, const std::function<void(Model&)>& meddle, long of_steps = steps,
                 bool again = false) {
  scene.solver.step_estimate = scene::StepEstimate::element;  // runs are so many steps of it
  Model model;
  build_model(scene, model);
  Meddler meddler;
  meddler.model = &model;
  meddler.from = of_steps / 2;
  meddler.meddle = meddle;
  meddler.again = again;
  model.step_count = of_steps;
  model.output_times.history = model.output_times.fields = 1e9 * model.step_size;
  run(model, {&meddler});
  return meddler;
}

/// Stopped by the energy check, before a twentieth of the run was wasted, or between two of the checks that the least
/// of runs has.
void check_stopped(const Meddler& meddler, long of_steps = steps) {
  INFO("meddled with at step " << meddler.done_at << "; " << meddler.said());
  REQUIRE(meddler.done_at > 0);
  CHECK(!meddler.summary.completed);
  REQUIRE(meddler.summary.fault);
  CHECK(meddler.summary.fault->kind == FaultKind::energy);
  CHECK(meddler.summary.steps - meddler.done_at <= std::max(64L, of_steps / 20));
}

/// Adds a velocity to a part's nodes, in turn up and down, so that no rigid motion comes of it.
void shake(Model& model, const std::string& part, double energy) {
  const auto velocity = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), model.nodes.velocity);
  const auto& nodes = model.assembly.node_sets.at(part);
  const double speed = std::sqrt(2 * energy / mass_of(model, part));
  double sign = 1;
  for (int n : nodes) velocity(n, 2) += (sign = -sign) * speed;
  Kokkos::deep_copy(model.nodes.velocity, velocity);
}

void move(Model& model, const std::string& set, double down) {
  const auto position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), model.nodes.position);
  for (int n : model.assembly.node_sets.at(set)) position(n, 2) -= down;
  Kokkos::deep_copy(model.nodes.position, position);
}

/// What rings in a body that is spun unsettled may be reported as hourglass energy.
std::string said_of_energy(const Meddler& meddler) {
  std::string all;
  for (const Fault& fault : meddler.faults)
    if (fault.kind != FaultKind::hourglass_share) all += fault.summary() + '\n';
  return all;
}

double deformation(const Meddler& meddler) { return deformation_energy(meddler.before); }

}  // namespace

TEST_CASE("a scene at rest far from the origin, damped and not loaded yet, makes no energy worth a word") {
  TwoBlocks blocks;
  scene::Scene scene = blocks.scene(1);
  for (scene::Part& part : scene.parts) {
    part.stiffness_damping = 1e-7;
    for (double& x : part.position) x += 1.37;
  }
  hold(scene, "lower.z_min", {true, true, true});
  add_pressure(scene, "upper.z_max", 1e7, "late");
  add_ramp(scene, "late", 1, 1e-4);
  const Meddler meddler = run_with(scene, {}, 500);
  CHECK(meddler.said() == "");
  CHECK(meddler.summary.completed);
}

TEST_CASE("a run that goes on with a model that has run before balances from where it goes on") {
  Model model;
  build_model(pressed_pair(scene::ContactAlgorithm::penalty), model);
  model.step_count = 500;
  REQUIRE(run(model, {}).completed);
  model.scene.initial_motions.clear();
  model.step_count = 1000;
  Meddler second;
  second.model = &model;
  run(model, {&second});
  CHECK(second.said() == "");
  CHECK(second.summary.completed);
}

TEST_CASE("energy that is made beside a fast heavy mass ends the run within a twentieth of it, whatever makes it") {
  for (const auto algorithm : both_algorithms) {
    INFO(name_of(algorithm));
    const scene::Scene scene = pressed_pair(algorithm);
    const Meddler sound = run_with(scene, {});
    CHECK(sound.said() == "");
    CHECK(sound.summary.completed);

    // As much as deforms, a millionth of what travels.
    double energy = 0;
    const Meddler quiet = run_with(scene, [&](Model&) {});
    energy = 1.5 * deformation(quiet);
    CHECK(energy < 1e-5 * quiet.before.kinetic);
    check_stopped(run_with(scene, [&](Model& model) { shake(model, "upper", energy); }));
    check_stopped(run_with(
                      scene, [&](Model& model) { shake(model, "upper", energy); }, 400),
                  400);
    // One node is found deep in the other body, as a wrong projection leaves it.
    check_stopped(run_with(scene, [&](Model& model) {
      const auto position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), model.nodes.position);
      position(model.contacts[0].slave_nodes[12], 2) -= 5e-4;
      Kokkos::deep_copy(model.nodes.position, position);
    }));
    // Little by little, a tenth of what deforms at each check: it ends once half is made, a few checks later at most.
    const Meddler slow = run_with(
        scene, [&](Model& model) { shake(model, "upper", energy / 15); }, 10 * steps, true);
    INFO(slow.said());
    REQUIRE(slow.summary.fault);
    CHECK(slow.summary.fault->kind == FaultKind::energy);
    CHECK(slow.summary.fault->value < 1);
    // Energy that is lost: all that both bodies hold.
    check_stopped(
        run_with(scene, [&](Model& model) { Kokkos::deep_copy(model.nodes.position, model.nodes.reference); }));
  }
}

TEST_CASE("an account of impacts that gives energy back is no excuse for it") {
  // Multipliers let nothing penetrate: what is pressed in they throw out, and book that as less taken by impacts.
  scene::Scene scene = pressed_pair(scene::ContactAlgorithm::multiplier);
  check_stopped(run_with(scene, [&](Model& model) { move(model, "upper", 2e-5); }));
}

TEST_CASE("a body that is carried along by a prescribed motion is no error") {
  scene::Scene scene = block_scene({0.05, 0.05, 0.05}, {3, 3, 3}, 1);
  scene.parts[0].take_hourglass(scene::HourglassType::stiffness);
  add_traveller(scene);
  add_ramp(scene, "start", 0, 2e-3);
  scene::PrescribedMotion motion;
  motion.name = "drive";
  motion.target = "block.x_min";
  motion.velocity = {100 / 3.6, 0, 0};
  motion.curve = "start";
  scene.prescribed_motions.push_back(motion);
  CHECK(said_of_energy(run_with(scene, {})) == "");
}

TEST_CASE("what only travels is no error: bodies in flight, spun and in free fall, beside a fast heavy mass") {
  for (const auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
    scene::Scene scene = block_scene({0.05, 0.05, 0.05}, {3, 3, 3}, 1);
    scene.solver.precision = precision;
    scene.parts[0].take_hourglass(scene::HourglassType::stiffness);
    scene.gravity = {0, 0, -9.81};
    add_traveller(scene);
    add_motion(scene, {"block"}, {100 / 3.6, 0, 0});
    INFO(static_cast<int>(precision));
    CHECK(said_of_energy(run_with(scene, {})) == "");
    scene.initial_motions.back().angular_velocity = {10, 20, 60};
    CHECK(said_of_energy(run_with(scene, {})) == "");
    // And alone, where rounding of the traveller hides nothing.
    scene.points.clear();
    scene.initial_motions.erase(scene.initial_motions.begin());
    CHECK(said_of_energy(run_with(scene, {})) == "");
  }
}

TEST_CASE("what a load begins to move has no energy of rounding") {
  // Soft and in one element: a step is so long that the load's first share is felt at once.
  scene::Scene scene = block_scene({0.4, 0.4, 0.4}, {1, 1, 1}, 0.2);
  scene.materials[0].youngs_modulus = 1e7;
  scene.materials[0].density = 1000;
  hold(scene, "block.z_min", {false, false, true});
  add_pressure(scene, "block.z_max", 1e6, "rise");
  scene::Curve rise;
  rise.name = "rise";
  rise.type = scene::CurveType::table;
  rise.points = {{0, 0}, {0.4, 1}};
  scene.curves.push_back(rise);
  CHECK(said_of_energy(run_with(scene, {})) == "");
}

namespace {

/// Falls slowly, far from the origin, and a mass that a spring carries: in a step of 1 ns places change by no more than
/// a few of their last digits.
scene::Scene slow_fall() {
  scene::Scene scene = block_scene({0.05, 0.05, 0.05}, {3, 3, 3}, 1);
  scene.parts[0].take_hourglass(scene::HourglassType::stiffness);
  scene.parts[0].position = {3, 0.1, 1};
  scene.gravity = {0, 0, -9.81};
  add_motion(scene, {"block"}, {1e-3, 0, 0});
  add_point(scene, "weight", 100, {0, 0, 2});
  add_spring(scene, "ground", "weight", {0, 0, 1e6}, {0, 0, 0});
  scene.connectors.back().preload = {0, 0, 900};
  return scene;
}

}  // namespace

TEST_CASE("runs of a few steps so short that places hardly change make no false alarm") {
  for (const double step : {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7})
    for (const long count : {1L, 2L, 7L, 31L, 100L}) {
      scene::Scene scene = slow_fall();
      scene.time.step = step;
      const Meddler meddler = run_with(scene, {}, count);
      INFO(count << " steps of " << step << " s");
      CHECK(meddler.said() == "");
      CHECK(meddler.summary.completed);
    }
}

TEST_CASE("a genuine failure in the first steps is found, however few they are") {
  // Energy of a billionth of a joule, made at the last step but a few: a thousand times what rounding explains.
  for (const double step : {1e-9, 1e-8})
    for (const long count : {2L, 8L}) {
      scene::Scene scene = slow_fall();
      scene.time.step = step;
      const Meddler meddler = run_with(
          scene, [](Model& model) { shake(model, "block", 1e-9); }, count);
      INFO(count << " steps of " << step << " s; " << meddler.said());
      CHECK(meddler.done_at == count / 2);
      CHECK(!meddler.summary.completed);
      REQUIRE(meddler.summary.fault);
      CHECK(meddler.summary.fault->kind == FaultKind::energy);
    }
  // A step of three times the stable one, in a run that ends before an error could last.
  scene::Scene scene = pressed_block();
  Model model;
  build_model(scene, model);
  model.step_size = 3 * element_height(model);
  model.step_count = 24;
  Meddler meddler;
  run(model, {&meddler});
  INFO(meddler.said());
  CHECK(!meddler.summary.completed);
}
