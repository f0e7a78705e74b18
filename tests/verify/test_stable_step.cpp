#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "model/time_step/global_step.hpp"
#include "model/time_step/stable_step.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

constexpr double tolerance = GlobalEstimate::tolerance;

/// Largest speed at any sample of `steps` steps from random velocities of up to 1 mm/s; infinite where not finite.
double largest_speed_in_run(Model& model, long steps) {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> speed(-1e-3, 1e-3);
  set_velocity(model, [&](const Vec3&, int n) {
    const bool held = to_host(model.nodes.constraint)(n) >= 0;
    Vec3 v{};
    for (double& c : v) c = speed(generator) * (held ? 0 : 1);
    return v;
  });
  double largest = 0;
  march(model, steps, [&] {
    if (model.step % 100 == 0) largest = std::max(largest, largest_speed(model));
  });
  return largest;
}

scene::Scene body(const std::array<int, 3>& divisions, scene::StepEstimate estimate, scene::HourglassType hourglass) {
  scene::Scene scene = block_scene({0.01 * divisions[0], 0.01 * divisions[1], 0.01 * divisions[2]}, divisions, 1);
  set_hourglass(scene.parts[0], hourglass, hourglass == scene::HourglassType::viscous ? 0.1 : 0.05);
  scene.solver.step_estimate = estimate;
  scene.time.step_scale = 0.99;
  return scene;
}

const scene::HourglassType both_kinds[] = {scene::HourglassType::viscous, scene::HourglassType::stiffness};

/// Two columns of 1 mm cubes on one another, moving along z only.
/// @param penalty_scale for each of the segment's four nodes, which inside a surface would have a segment each
scene::Scene pressed_columns(int length, double penalty_scale) {
  TwoBlocks blocks;
  blocks.upper_size = blocks.lower_size = {1e-3, 1e-3, 1e-3 * length};
  blocks.upper_divisions = blocks.lower_divisions = {1, 1, length};
  scene::Scene scene = blocks.scene(1);
  scene.contacts[0].penalty_scale = penalty_scale;
  for (const char* part : {"upper", "lower"}) hold(scene, part, {true, true, false});
  scene.solver.step_estimate = scene::StepEstimate::global;
  return scene;
}

}  // namespace

TEST_CASE("a cube's eigenvalue step is that of its volume mode, 0.734 of the height's") {
  const double h = 0.01, density = steel().density;
  const HexahedronCorners cube{
      {{0, 0, 0}, {h, 0, 0}, {h, h, 0}, {0, h, 0}, {0, 0, h}, {h, 0, h}, {h, h, h}, {0, h, h}}};
  const double mu = steel().shear_modulus(), lambda = steel().dilatational_modulus() - 2 * mu;
  const double step = element_eigenvalue_step(cube, steel(), scene::HourglassType::stiffness, 0.05).step;
  CHECK_THAT(step, WithinRel(h * std::sqrt(density / (3 * lambda + 2 * mu)), 1e-12));
  CHECK_THAT(step, WithinRel(0.734 * h / steel().dilatational_speed(), 1e-3));
  // A control so strong that its own modes are the highest: eight corners' gamma^2 = 8 k / m.
  const double strong = element_eigenvalue_step(cube, steel(), scene::HourglassType::stiffness, 4).step;
  const double k = 4 * steel().dilatational_modulus() * h / 16, m = density * h * h * h / 8;
  CHECK_THAT(strong, WithinRel(2 / std::sqrt(8 * k / m), 1e-12));
  const double c = 0.25 * 3 * density * steel().dilatational_speed() * h * h;
  CHECK_THAT(element_eigenvalue_step(cube, steel(), scene::HourglassType::viscous, 3).step,
             WithinRel(2 / (8 * c / m), 1e-12));
}

TEST_CASE("the step of one warped element: never above that of its own highest frequency, and near it") {
  for (auto hourglass : both_kinds)
    for (unsigned seed = 1; seed <= 20; ++seed) {
      scene::Scene scene = body({1, 1, 1}, scene::StepEstimate::global, hourglass);
      Assembly assembly = assemble(scene);
      warp(assembly, 0.01, 0.25, seed);
      Model model;
      build_model(scene, assembly, model);
      INFO("seed " << seed << ", eigenvalue " << model.stable_step.eigenvalue << " s, global "
                   << model.stable_step.global << " s");
      // The global estimate of a lone element is exact: there are fewer motions than iterations.
      GlobalStep exact = (*model.global_estimate)({}, model.stable_step.eigenvalue);
      CHECK(model.stable_step.eigenvalue <= exact.step * (1 + 1e-6));
      // The coupling of stiffness and hourglass control in a warped element is bounded, not solved for.
      CHECK(model.stable_step.eigenvalue >= exact.step * 0.85);
    }
}

TEST_CASE("bodies one element thick stay calm for 20000 steps of the eigenvalue's step") {
  for (auto hourglass : both_kinds)
    for (const auto& divisions : {std::array<int, 3>{1, 1, 1}, {6, 1, 1}, {5, 5, 1}, {3, 3, 3}}) {
      Model model;
      build_model(body(divisions, scene::StepEstimate::eigenvalue, hourglass), model);
      const double fastest = largest_speed_in_run(model, 20000);
      INFO(divisions[0] << " x " << divisions[1] << " x " << divisions[2] << ", fastest " << fastest << " m/s");
      CHECK(fastest < 0.01);
    }
}

TEST_CASE("the global step is the true limit: calm at 0.99 of it, not at 1.03, and never below the eigenvalue's") {
  // Of the height's step: a lone cube 0.73, a bar 0.79, a plate 0.86.
  const struct {
    std::array<int, 3> divisions;
    scene::HourglassType hourglass;
    double limit;
  } bodies[] = {{{1, 1, 1}, scene::HourglassType::stiffness, 0.734},
                {{12, 1, 1}, scene::HourglassType::viscous, 0.79},
                {{10, 10, 1}, scene::HourglassType::viscous, 0.86},
                {{12, 1, 1}, scene::HourglassType::stiffness, 0.81},
                {{10, 10, 1}, scene::HourglassType::stiffness, 0.90}};
  for (const auto& [divisions, hourglass, limit] : bodies) {
    const scene::Scene scene = body(divisions, scene::StepEstimate::global, hourglass);
    Model model;
    build_model(scene, model);
    const StableStep& stable = model.stable_step;
    INFO(divisions[0] << " x " << divisions[1] << " x " << divisions[2] << ": " << stable.global / stable.elements);
    CHECK_THAT(stable.global / stable.elements, WithinRel(limit, 0.02));
    // A lone cube has but its own frequency: the same number found in two ways, each rounded.
    INFO("above the eigenvalue's by " << stable.global / stable.eigenvalue - 1);
    CHECK(stable.global >= (1 - 1e-12) * stable.eigenvalue);
    CHECK(largest_speed_in_run(model, 20000) < 0.01);

    Model beyond;
    build_model(scene, beyond);
    beyond.step_size = 1.03 * stable.global;
    CHECK(largest_speed_in_run(beyond, 2000) > 1);
  }
}

TEST_CASE("viscous hourglass control is in the global step as the damping it is") {
  for (double coefficient : {0.1, 1.0}) {
    scene::Scene scene = body({4, 4, 4}, scene::StepEstimate::global, scene::HourglassType::viscous);
    scene.parts[0].hourglass_coefficient = coefficient;
    Assembly assembly = assemble(scene);
    warp(assembly, 0.01, 0.2, 5);
    Model model;
    build_model(scene, assembly, model);
    INFO("Q_hg " << coefficient << ": global / eigenvalue step "
                 << model.stable_step.global / model.stable_step.eigenvalue);
    CHECK(model.stable_step.global >= model.stable_step.eigenvalue);
    CHECK(largest_speed_in_run(model, 20000) < 0.01);
    Model beyond;
    build_model(scene, assembly, beyond);
    beyond.step_size = 1.04 * model.stable_step.global;
    CHECK(largest_speed_in_run(beyond, 4000) > 1);
  }
}

TEST_CASE("strong viscous hourglass control shortens the element estimate to what it can bear") {
  for (double coefficient : {0.1, 0.2, 0.4}) {
    scene::Scene scene = body({6, 6, 6}, scene::StepEstimate::element, scene::HourglassType::viscous);
    set_hourglass(scene.parts[0], scene::HourglassType::viscous, coefficient);
    scene.time.step_scale = 0.9;
    Model model;
    build_model(scene, model);
    INFO("coefficient " << coefficient);
    CHECK(largest_speed_in_run(model, 5000) < 1e-3);

    // By the elements' heights alone, 10 mm over the speed of dilatational waves.
    Model by_heights;
    build_model(scene, by_heights);
    by_heights.step_size = 0.9 * 0.01 / scene.materials[0].dilatational_speed();
    if (coefficient > 0.15)
      CHECK(!(largest_speed_in_run(by_heights, 5000) < 1));
    else
      CHECK_THAT(model.stable_step.elements, WithinRel(0.01 / scene.materials[0].dilatational_speed(), 1e-6));
  }
}

TEST_CASE("contact at f_SI = 1 in a chain of 1 mm elements allows 0.88 of the elements' own step") {
  // The chain is one-dimensional: without hourglass motion, which viscous control damps.
  const auto chain = [](double hourglass) {
    scene::Scene scene = pressed_columns(20, 0.25);
    for (scene::Part& part : scene.parts) part.hourglass_coefficient = hourglass;
    return scene;
  };
  const double own = 1e-3 / steel().dilatational_speed();
  Model model;
  build_model(chain(0), model);
  CHECK(model.stable_step.springs == 4);
  INFO("global step / elements' own: " << model.stable_step.global / own);
  CHECK_THAT(model.stable_step.global / own, WithinRel(0.879, 0.5 * tolerance + 1e-3));

  // The surface's hourglass pattern, nodes up and down in turn: springs alone, 2 k/m = 4 K/(rho h^2), and the dashpots'
  // rate 16 Q_hg C_d/h.
  Model damped;
  build_model(chain(0.1), damped);
  const double spring = 4 * steel().bulk_modulus() / steel().dilatational_modulus(), rate = 16 * 0.1;
  CHECK_THAT(damped.stable_step.global / own,
             WithinRel(2 / (std::sqrt(spring + 0.25 * rate * rate) + 0.5 * rate), 0.5 * tolerance + 1e-3));

  // Apart, the same columns have their elements' own step.
  scene::Scene apart = chain(0);
  apart.parts[0].position[2] = 5e-3;
  Model free;
  build_model(apart, free);
  CHECK(free.stable_step.springs == 0);
  CHECK_THAT(free.stable_step.global / own, WithinRel(1.0, 0.5 * tolerance + 1e-3));
}

TEST_CASE("pressed columns stay calm at 0.99 of the global step, not at 1.03") {
  for (double scale : {0.99, 1.03}) {
    scene::Scene scene = pressed_columns(6, 1);
    scene.time.end = 1e-3;
    scene.gravity = {0, 0, -1e7};
    hold(scene, "lower.z_min", {true, true, true});
    scene.settle.active = true;
    Model model;
    build_model(scene, model);
    REQUIRE(settle_whole(model).settled);
    INFO("by eigenvalues " << model.stable_step.by_eigenvalues << " s, global " << model.stable_step.global << " s");
    CHECK(model.stable_step.by_eigenvalues <= model.stable_step.global);
    model.step_size = scale * model.stable_step.global;
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> speed(-1e-4, 1e-4);
    set_velocity(model, [&](const Vec3& x, int) { return Vec3{0, 0, x[2] < -5.9e-3 ? 0 : speed(generator)}; });
    double fastest = 0;
    march(model, 20000, [&] {
      if (model.step % 100 == 0) fastest = std::max(fastest, largest_speed(model));
    });
    INFO("scale " << scale << ", fastest " << fastest);
    // Beyond the limit the surfaces rattle apart and together instead of growing without bound.
    if (scale < 1)
      CHECK(fastest < 0.1);
    else
      CHECK(fastest > 1);
  }
}

TEST_CASE(
    "springs and dashpots on a point mass: the global step is 2/omega (sqrt(1 + zeta^2) - zeta), a dashpot's alone 2 "
    "m/c") {
  const double mass = 2;
  for (double k : {0.0, 8e4})
    for (double c : {0.0, 300.0}) {
      if (k == 0 && c == 0) continue;
      scene::Scene scene;
      scene.path = "ball";
      add_point(scene, "ball", mass, {0, 0, 0});
      add_spring(scene, "ground", "ball", {0, k, 0}, {0, c, 0});
      scene.time.end = 1;
      scene.solver.step_estimate = scene::StepEstimate::global;
      Model model;
      build_model(scene, model);
      const double squared = k / mass, half_rate = 0.5 * c / mass;
      INFO("k " << k << ", c " << c);
      CHECK_THAT(model.stable_step.global,
                 WithinRel(2 / (std::sqrt(squared + half_rate * half_rate) + half_rate), tolerance));
    }
}

TEST_CASE("whatever estimates the step, bodies that strike undamped contact springs take nine tenths of it") {
  for (const auto choice :
       {scene::StepEstimate::element, scene::StepEstimate::eigenvalue, scene::StepEstimate::global}) {
    TwoBlocks blocks;
    blocks.gap = 1e-6;
    scene::Scene scene = blocks.scene(1e-3);
    for (scene::Part& part : scene.parts) part.take_hourglass(scene::HourglassType::stiffness);
    scene.solver.step_estimate = choice;
    add_motion(scene, {"upper"}, {0, 0, -1});
    const auto limit = [](const scene::Scene& of) {
      Model model;
      build_model(of, model);
      return model.stable_step.limit;
    };
    const double striking = limit(scene);
    scene.settle.active = true;  // what rests on its springs keeps them closed
    INFO(static_cast<int>(choice));
    CHECK_THAT(striking / limit(scene), WithinRel(0.9, 1e-12));
  }
}
