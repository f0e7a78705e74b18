#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// A block of other mesh than the one below, pressed on it by 78 MPa and pulled along x by 0.9 of what friction can
/// hold.
scene::Scene pressed(scene::ContactAlgorithm algorithm, int sweeps) {
  TwoBlocks blocks;
  blocks.algorithm = algorithm;
  blocks.upper_divisions = {7, 9, 2};
  blocks.friction = 0.3;
  scene::Scene scene = blocks.scene(3e-4);
  scene.contacts[0].sweeps = sweeps;
  scene.time.step_scale = 0.6;
  hold(scene, "lower.z_min", {true, true, true});
  const double weight = 7800 * 0.04 * 0.04 * 0.01 * 1e6;
  add_force(scene, "upper", {0, 0, -weight});
  add_ramp(scene, "pull", 0, 1e-4);
  add_force(scene, "upper", {0.9 * 0.3 * weight, 0, 0}, "pull");
  scene.settle.active = true;
  scene.settle.tolerance = 1e-5;
  return scene;
}

struct Deepest {
  double penetration = 0;  ///< m
  double creep = 0;        ///< m, of a sticking node from where it stuck
};

Deepest deepest(const scene::Scene& scene) {
  Model model;
  build_model(scene, model);
  CHECK(settle_whole(model).settled);
  Deepest result;
  march(model, model.step_count, [&] {
    const ContactPair& pair = model.contacts[0];
    const auto gap = to_host(pair.arrays.gap);
    const auto status = to_host(pair.arrays.status);
    for (int s = 0; s < pair.arrays.slave_count; ++s) result.penetration = std::max(result.penetration, -gap(s));
    if (!pair.multipliers.active()) return;
    const auto way = to_host(pair.multipliers.way_since_stuck);
    for (int s = 0; s < pair.arrays.slave_count; ++s)
      if (status(s) == status_sticks)
        result.creep = std::max(result.creep, std::hypot(way(s, 0), way(s, 1), way(s, 2)));
  });
  return result;
}

}  // namespace

TEST_CASE("multipliers leave a pressed and pulled block neither penetrating nor creeping") {
  const double springs = deepest(pressed(scene::ContactAlgorithm::penalty, 1)).penetration;
  // Pressure over bulk modulus times an element's height: what thesis eq. 2.26 needs.
  CHECK(springs > 78e6 / 175e9 * 5e-3);
  for (int sweeps : {2, 4, 8}) {
    const Deepest result = deepest(pressed(scene::ContactAlgorithm::multiplier, sweeps));
    INFO(sweeps << " sweeps: penetration " << result.penetration << " m, of springs " << springs << "; creep "
                << result.creep);
    CHECK(result.penetration < 1e-3 * springs);
    CHECK(result.creep < 1e-3 * springs);
  }
}

TEST_CASE("multipliers do not shorten the stable step") {
  Model with, without;
  build_model(pressed(scene::ContactAlgorithm::multiplier, 4), with);
  scene::Scene scene = pressed(scene::ContactAlgorithm::multiplier, 4);
  scene.contacts.clear();
  build_model(scene, without);
  CHECK(with.stable_step.by_elements == without.stable_step.by_elements);
  CHECK(with.stable_step.by_eigenvalues == without.stable_step.by_eigenvalues);
  scene = pressed(scene::ContactAlgorithm::penalty, 4);
  Model springs;
  build_model(scene, springs);
  CHECK(springs.stable_step.by_elements < with.stable_step.by_elements);
}

namespace {

/// A block of other mesh than the one below, under 78 MPa, with friction that holds nearly all of it.
scene::Scene stuck() {
  TwoBlocks blocks;
  blocks.algorithm = scene::ContactAlgorithm::multiplier;
  blocks.upper_size = {0.02, 0.02, 0.01};
  blocks.lower_size = {0.03, 0.03, 0.01};
  blocks.upper_divisions = {5, 7, 2};
  blocks.lower_divisions = {6, 6, 2};
  blocks.friction = 0.5;
  scene::Scene scene = blocks.scene(1e-2);
  scene.contacts[0].sweeps = 2;
  for (scene::Part& part : scene.parts) set_hourglass(part, scene::HourglassType::stiffness, 0.05);
  hold(scene, "lower.z_min", {true, true, true});
  add_force(scene, "upper", {0, 0, -78e6 * 0.02 * 0.02});
  scene.settle.active = true;
  return scene;
}

}  // namespace

TEST_CASE("friction in a stuck patch of multipliers takes no more than a jolt has brought in") {
  Model model;
  build_model(stuck(), model);
  CHECK(settle_whole(model).settled);
  set_velocity(model, [](const Vec3& x, int node) {
    std::mt19937 generator(static_cast<unsigned>(node));
    std::uniform_real_distribution<double> speed(-1, 1);
    return x[2] < -0.0099 ? Vec3{} : Vec3{speed(generator), speed(generator), speed(generator)};
  });
  double brought = 0;
  EnergyAccount last;
  march(model, 20000, [&] {
    if (model.step % 1000 != 0) return;
    const EnergyAccount now = account_energies(model, model.step_size);
    if (model.step == 0) brought = now.kinetic;
    INFO("step " << model.step << ": kinetic " << now.kinetic << " J, friction " << now.friction << " J, brought in "
                 << brought << " J");
    // From rest under a load nothing else can be had. Residuals taken back at once: 18 times that in 6000 steps.
    CHECK(now.kinetic + now.friction <= (1 + 1e-12) * brought);
    CHECK(now.friction >= last.friction - 1e-12 * brought);
    last = now;
  });
}
