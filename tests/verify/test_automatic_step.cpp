#include "model/time_step/automatic_step.hpp"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "benchmarks/stability/distortions.hpp"
#include "model/time_step/deformed_elements.hpp"
#include "model/time_step/global_step.hpp"
#include "model/time_step/stable_step.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;
using StepReason = StepChoice::Reason;

namespace {

/// Largest speed at samples of a run of `steps` steps from random velocities of up to 1 mm/s.
double shaken(Model& model, long steps) {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> speed(-1e-3, 1e-3);
  const auto held = to_host(model.nodes.constraint);
  set_velocity(model, [&](const Vec3&, int n) {
    Vec3 v{};
    for (double& c : v) c = speed(generator) * (held(n) < 0 ? 1 : 0);
    return v;
  });
  double largest = 0;
  march(model, steps, [&] {
    if (model.step % 100 == 0) largest = std::fmax(largest, largest_speed(model));
  });
  return largest;
}

scene::Scene distorted_scene(const bench::Distortion& distortion, double end) {
  const auto& n = distortion.divisions;
  const Vec3& h = distortion.size;
  scene::Scene scene = block_scene({n[0] * h[0], n[1] * h[1], n[2] * h[2]}, n, end);
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  return scene;
}

/// An upper block that a force drives over a gap onto the lower one, both on meshes that are long along z: the step by
/// elements is that of the contact springs, the whole scene's is longer until they press.
scene::Scene driven_blocks() {
  TwoBlocks blocks;
  blocks.upper_size = blocks.lower_size = {3e-3, 3e-3, 3e-3};
  blocks.upper_divisions = blocks.lower_divisions = {3, 3, 3};
  blocks.gap = 2e-3;
  scene::Scene scene = blocks.scene(3e-3);
  for (scene::Part& part : scene.parts) set_hourglass(part, scene::HourglassType::viscous, 0.1);
  scene.contacts[0].penalty_scale = 5;
  hold(scene, "lower.z_min", {true, true, true});
  add_force(scene, "upper.z_max", {0, 0, -2});
  scene.output.history_interval = 0;  // each step
  return scene;
}

}  // namespace

TEST_CASE("a longer step pays by the evaluations that it saves, never in a short run") {
  CHECK(std::isinf(least_gain(100, false)));
  CHECK(std::isinf(least_gain(1999, true)));
  // A search of 70 applications worth two evaluations each, with contact springs two, and half as much again.
  CHECK_THAT(least_gain(3000, false), WithinRel(1 / (1 - 0.07), 1e-12));
  CHECK_THAT(least_gain(3000, true), WithinRel(1 / (1 - 0.14), 1e-12));
  CHECK_THAT(least_gain(1e6, true), WithinRel(1 / 0.95, 1e-12));
}

TEST_CASE("the default's step is within the border of every mesh of the stability map, thin ones too", "[automatic]") {
  for (const bench::Distortion& distortion : bench::distortions()) {
    scene::Scene scene = distorted_scene(distortion, 1);
    REQUIRE(scene.solver.step_estimate == scene::StepEstimate::automatic);
    scene.time.step_scale = 0.999;
    Assembly assembly = assemble(scene);
    bench::distort(distortion, assembly);
    Model model;
    build_model(scene, assembly, model);
    const StableStep& stable = model.stable_step;
    INFO(distortion.name << ": " << describe_choice(stable.choice));
    const bool badly_shaped = distortion.name == "warped" || distortion.name == "near-degenerate";
    if (badly_shaped) CHECK(stable.choice.reason == StepReason::pays);
    if (distortion.name == "cubes") CHECK(stable.choice.reason == StepReason::gains_little);
    CHECK(stable.limit >= std::fmax(stable.by_elements, stable.by_eigenvalues));
    CHECK((stable.choice.reason == StepReason::pays) == (stable.global > 0));
    CHECK(model.global_estimate.operator bool() == (stable.choice.reason == StepReason::pays));
    CHECK(shaken(model, 3000) < 0.01);
    if (!badly_shaped) continue;
    Model beyond;
    build_model(scene, assembly, beyond);
    beyond.step_size = 1.03 * stable.limit;
    CHECK(shaken(beyond, 3000) > 1);
  }
}

TEST_CASE("what deformed elements allow is within what the deformed body bears, and not far below", "[automatic]") {
  const std::array<std::array<Vec3, 3>, 6> deformations{{
      {Vec3{0.5, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}},        // squeezed
      {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 0.5}},        // along the other end of columns
      {Vec3{2, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 0.25}},       // flattened at constant volume
      {Vec3{0.7, 0, 0}, Vec3{0, 1 / 0.7, 0}, Vec3{0, 0, 1}},  // pure shear
      {Vec3{1, 0, 1}, Vec3{0, 1, 0}, Vec3{0, 0, 1}},          // simple shear
      {Vec3{0.8, 0, 0}, Vec3{0, 0.8, 0}, Vec3{0, 0, 0.8}}     // smaller all over
  }};
  for (const bench::Distortion& distortion : bench::distortions()) {
    scene::Scene scene = distorted_scene(distortion, 1);
    scene.solver.step_estimate = scene::StepEstimate::global;
    Assembly assembly = assemble(scene);
    bench::distort(distortion, assembly);
    Model model;
    build_model(scene, assembly, model);
    const DeformedElements elements = deformed_elements(model, nullptr);
    const StableStep& stable = model.stable_step;
    const double whole = stable.global, by_elements = stable.by_elements;
    const DeformedNow undeformed = measure_now(elements, model, whole, by_elements);
    CHECK(undeformed.first >= (1 - 1e-6) * whole);
    CHECK(undeformed.second >= (1 - 1e-6) * by_elements);
    for (std::size_t k = 0; k < deformations.size(); ++k) {
      const auto& F = deformations[k];
      set_position(model, [&](const Vec3& x, int) { return Vec3{dot(F[0], x), dot(F[1], x), dot(F[2], x)}; });
      const double bears = (*model.global_estimate)({0.0}, whole).step;
      const DeformedNow now = measure_now(elements, model, whole, by_elements);
      INFO(distortion.name << ", deformation " << k << ": allowed over borne " << now.first / bears << ", "
                           << now.second / bears);
      CHECK(now.first <= 1.01 * bears);  // what the estimate may lack is 1 % of the squared frequency
      CHECK(now.second <= 1.01 * bears);
      if (distortion.name == "cubes") CHECK(now.second > 0.6 * bears);
    }
  }
}

TEST_CASE("pressed blocks stay calm at the default's step; contact springs are counted in", "[automatic]") {
  for (bool plates : {false, true}) {
    TwoBlocks blocks;
    const int rows = plates ? 1 : 3;
    blocks.upper_size = {4e-3, 4e-3, 1e-3 * rows};
    blocks.lower_size = {6e-3, 6e-3, 1e-3 * rows};
    blocks.upper_divisions = {4, 4, rows};
    blocks.lower_divisions = {6, 6, rows};
    scene::Scene scene = blocks.scene(1);
    for (scene::Part& part : scene.parts) set_hourglass(part, scene::HourglassType::stiffness, 0.05);
    hold(scene, "lower.z_min", {true, true, true});
    hold(scene, "upper.z_max", {true, true, false});
    scene.gravity = {0, 0, -3e6};
    scene.settle.active = true;
    scene.time.step_scale = 0.999;
    Model model;
    build_model(scene, model);
    REQUIRE(settle_whole(model).settled);
    INFO((plates ? "plates: " : "blocks: ") << describe_choice(model.stable_step.choice));
    CHECK(model.stable_step.limit >= model.stable_step.by_elements);
    model.step_size = largest_step(scene.time, model.stable_step);
    CHECK(shaken(model, 5000) < 0.1);
  }
}

TEST_CASE("no node presses that the default's step has not counted, however suddenly it comes", "[automatic]") {
  const scene::Scene scene = driven_blocks();
  Model model;
  build_model(scene, model);
  const StableStep& stable = model.stable_step;
  INFO(describe_choice(stable.choice));
  REQUIRE(stable.choice.reason == StepReason::pays);
  CHECK(stable.springs == 0);

  struct Touches : RunObserver {
    const StableStep* stable = nullptr;
    long touching = 0, uncounted = 0, sampled = 0;
    double in_contact = 0;
    void history(const Model& model, const HistorySample&) override {
      ++sampled;
      const auto status = to_host(model.contacts[0].arrays.status);
      const bool whole = stable->choice.reason == StepReason::pays;
      bool touches = false;
      for (int s = 0; s < model.contacts[0].arrays.slave_count; ++s) {
        if (status(s) == status_apart) continue;
        touches = true;
        ++touching;
        if (whole && !stable->seen[0][s]) ++uncounted;
      }
      if (touches) in_contact = model.step_size;
    }
  } seen;
  seen.stable = &stable;
  const RunSummary summary = run(model, {&seen});
  REQUIRE(summary.completed);
  INFO("at the end: " << describe_choice(stable.choice));
  CHECK(seen.sampled > summary.steps / 2);
  CHECK(seen.touching > 100);
  CHECK(seen.uncounted == 0);
  CHECK(seen.in_contact < 0.5 * summary.largest_step);
  CHECK(summary.step_renewals >= 2);
  CHECK(summary.smallest_step < summary.largest_step);
}

TEST_CASE("the default takes the elements' step where something speaks against a longer one", "[automatic]") {
  const auto reason = [](const scene::Scene& scene) {
    Model model;
    build_model(scene, model);
    CHECK(model.stable_step.limit == model.stable_step.by_elements);
    CHECK(model.stable_step.global == 0);
    CHECK_FALSE(model.global_estimate);
    CHECK_FALSE(model.contacts[0].counts_springs());
    return model.stable_step.choice.reason;
  };
  scene::Scene scene = driven_blocks();
  scene.time.end = 1e-5;
  CHECK(reason(scene) == StepReason::short_run);
  scene.time.end = 1e-2;
  for (scene::Part& part : scene.parts) set_hourglass(part, scene::HourglassType::stiffness, 0.05);
  CHECK(reason(scene) == StepReason::strikes);
  scene.time.step = 1e-9;
  CHECK(reason(scene) == StepReason::step_given);
  scene.time.step = 0;
  scene.solver.subcycling = true;
  CHECK(reason(scene) == StepReason::strikes);  // no element is coarse enough for a longer step of its own
  scene::Scene coarse = scene;
  coarse.meshes[1].box.size = {0.3, 0.3, 0.6};
  coarse.meshes[1].box.divisions = {6, 6, 12};
  coarse.parts[1].position = {-0.15, -0.15, -0.6};
  CHECK(reason(coarse) == StepReason::subcycled);
  scene.solver.subcycling = false;
  scene.materials[0].yield_stress = 1e9;
  scene.materials[0].tangent_modulus = 1e9;
  add_motion(scene, {"upper"}, {0, 0, -200});
  CHECK(reason(scene) == StepReason::flows);
}
