#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

constexpr double friction = 0.3, pressing = 1e6;  // m/s2, as a force on each kg
const double ramp_end = 2e-4;

/// A block pressed on another and pulled along x by `share` of what friction can hold.
scene::Scene pulled_block(scene::ContactAlgorithm algorithm, double share, std::array<int, 3> upper_divisions) {
  TwoBlocks blocks;
  blocks.algorithm = algorithm;
  blocks.upper_divisions = upper_divisions;
  blocks.friction = friction;
  scene::Scene scene = blocks.scene(5e-4);
  hold(scene, "lower.z_min", {true, true, true});
  const double mass = 7800 * 0.04 * 0.04 * 0.01;
  add_force(scene, "upper", {0, 0, -mass * pressing});
  scene.time.step_scale = 0.6;  // edge and corner nodes bear the whole contact spring on a part of the mass
  add_ramp(scene, "pull", 0, ramp_end);
  add_force(scene, "upper", {share * friction * mass * pressing, 0, 0}, "pull");
  scene.settle.active = true;
  scene.settle.tolerance = 1e-5;
  return scene;
}

/// The largest tangential force over friction times normal force, of all nodes.
double largest_ratio(const ContactPair& pair) {
  const auto normal = to_host(pair.arrays.normal_force), tangential = to_host(pair.arrays.tangential_force);
  double largest = 0;
  for (int s = 0; s < pair.arrays.slave_count; ++s) {
    const double n = std::hypot(normal(s, 0), normal(s, 1), normal(s, 2));
    const double t = std::hypot(tangential(s, 0), tangential(s, 1), tangential(s, 2));
    if (n == 0)
      CHECK(t == 0);
    else
      largest = std::max(largest, t / (friction * n));
  }
  return largest;
}

std::vector<std::pair<scene::ContactAlgorithm, std::array<int, 3>>> variants() {
  std::vector<std::pair<scene::ContactAlgorithm, std::array<int, 3>>> result;
  for (auto algorithm : both_algorithms)
    for (auto divisions : {std::array<int, 3>{8, 8, 2}, {7, 9, 2}}) result.emplace_back(algorithm, divisions);
  return result;
}

struct Slide {
  std::vector<double> time, displacement, velocity;
  double ratio = 0, reaction = 0, imbalance = 0, largest = 0, mass = 0;
  EnergyAccount last;

  std::size_t at(double t) const {
    std::size_t k = 0;
    while (k + 1 < time.size() && time[k] < t) ++k;
    return k;
  }
};

Slide slide(const scene::Scene& scene) {
  Model model;
  build_model(scene, model);
  CHECK(settle_whole(model).settled);
  const auto& upper = model.assembly.node_sets.at("upper");
  const double start = mean(model, NodeField::displacement, upper)[0];
  Slide result;
  result.mass = mass_of(model, "upper");
  double first = 0;
  march(model, model.step_count, [&] {
    if (model.step % 5 != 0) return;
    result.time.push_back(model.time);
    result.displacement.push_back(mean(model, NodeField::displacement, upper)[0] - start);
    result.velocity.push_back(mean(model, NodeField::velocity, upper)[0]);
    result.ratio = std::max(result.ratio, largest_ratio(model.contacts[0]));
    result.reaction = std::max(result.reaction, reaction_error(contact_totals(model, model.contacts, 0)));
    result.last = account_energies(model, model.step_size);
    if (model.step == 0) first = balance_total(result.last);
    result.largest = std::max(result.largest, largest_energy(result.last));
    result.imbalance = std::max(result.imbalance, std::fabs(balance_total(result.last) - first));
  });
  return result;
}

}  // namespace

TEST_CASE("a block pulled with nine tenths of its friction stays where it is") {
  for (auto [algorithm, divisions] : variants()) {
    const scene::Scene scene = pulled_block(algorithm, 0.9, divisions);
    const Slide result = slide(scene);
    // Elastic size: shear of the block and of the contact springs (stiffness K / 5 mm for each area) under the whole
    // pull.
    const double shear_stress = 0.9 * friction * pressing * 7800 * 0.01;
    const double elastic = shear_stress * (0.01 / 80.8e9 + 0.02 / 80.8e9 + 0.005 / 175e9);
    double largest = 0;
    for (double u : result.displacement) largest = std::max(largest, std::fabs(u));
    const double late = result.displacement.back() - result.displacement[result.at(3.5e-4)];
    INFO(name_of(algorithm) << ": moved " << largest << ", elastic " << elastic << ", of it late " << late
                            << ", imbalance " << result.imbalance / result.largest);
    CHECK(largest > 0.1 * elastic);
    CHECK(largest < 3 * elastic);
    CHECK(std::fabs(late) < 0.2 * elastic);
    CHECK(result.ratio < 1 + 1e-12);
    CHECK(result.reaction < 1e-12);
  }
}

TEST_CASE(
    "a block pulled with eleven tenths of its friction slides with (T - mu N)/m and heats by mu N times the way") {
  for (auto [algorithm, divisions] : variants()) {
    const scene::Scene scene = pulled_block(algorithm, 1.1, divisions);
    const Slide result = slide(scene);
    const std::size_t a = result.at(2.5e-4), b = result.time.size() - 1;
    const double acceleration = (result.velocity[b] - result.velocity[a]) / (result.time[b] - result.time[a]);
    INFO(name_of(algorithm) << ": acceleration " << acceleration << ", friction energy " << result.last.friction
                            << ", way " << result.displacement[b] << ", imbalance / largest "
                            << result.imbalance / result.largest);
    CHECK_THAT(acceleration, WithinRel(0.1 * friction * pressing, 0.01));
    CHECK_THAT(result.last.friction, WithinRel(friction * result.mass * pressing * result.displacement[b], 0.01));
    CHECK(result.imbalance < 0.01 * result.largest);
    CHECK(result.ratio < 1 + 1e-12);
    CHECK(result.ratio > 1 - 1e-12);
    CHECK(result.reaction < 1e-12);
  }
}
