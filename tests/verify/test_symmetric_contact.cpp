#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

/// Both bodies' nodes against the other's faces; and several pairs in a scene, with nodes in common.
using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double pressing = 1e6;  // m/s2

/// A block of `upper` divisions that rests on a held one of `lower` divisions, stiffness hourglass control, settled.
void build_resting(Model& model, bool symmetric, std::array<int, 3> upper, std::array<int, 3> lower,
                   double friction = 0) {
  TwoBlocks blocks;
  blocks.upper_size = {0.04, 0.04, 0.02};
  blocks.lower_size = {friction > 0 ? 0.08 : 0.04, 0.04, 0.02};  // room to slide
  blocks.upper_divisions = upper;
  blocks.lower_divisions = lower;
  blocks.friction = friction;
  scene::Scene scene = blocks.scene(5e-4);
  scene.contacts[0].symmetric = symmetric;
  scene.time.step_scale = 0.6;
  for (scene::Part& part : scene.parts) part.hourglass = scene::HourglassType::stiffness;
  hold(scene, "lower.z_min", {true, true, true});
  add_force(scene, "upper", {0, 0, -7800 * 0.04 * 0.04 * 0.02 * pressing});
  if (friction > 0) {
    add_ramp(scene, "pull", 0, 2e-4);
    add_force(scene, "upper", {1.1 * friction * 7800 * 0.04 * 0.04 * 0.02 * pressing, 0, 0}, "pull");
  }
  scene.settle.active = true;
  scene.settle.tolerance = 1e-5;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  INFO("unbalance " << report.unbalance << " after " << report.steps << " steps");
  REQUIRE(report.settled);
  compute_forces(model);
}

double total_pressing() { return 7800 * 0.04 * 0.04 * 0.02 * pressing; }

/// Deepest place of the master's nodes below the plane of the slave's faces at rest, over the mean penetration.
double spread_of(const std::vector<double>& pressure, const std::vector<double>& area) {
  double least = 1e300, most = 0;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (area[i] > 0) {
      least = std::min(least, pressure[i] / area[i]);
      most = std::max(most, pressure[i] / area[i]);
    }
  return most / least;
}

}  // namespace

TEST_CASE("a symmetric contact presses with the whole weight, shared by both surfaces' nodes, equal and opposite") {
  for (auto [upper, lower] : {std::pair{std::array<int, 3>{4, 4, 2}, std::array<int, 3>{4, 4, 2}},
                              {{3, 3, 2}, {8, 8, 3}},
                              {{8, 7, 3}, {3, 4, 2}}}) {
    Model model;
    build_resting(model, true, upper, lower);
    REQUIRE(model.contacts.size() == 2);
    const ContactTotals totals = contact_totals(model, model.contacts, 0);
    CHECK_THAT(totals.normal_force[2], WithinRel(total_pressing(), 1e-3));
    CHECK(reaction_error(totals) < 1e-12);
    const HistorySample sample = take_sample(model, model.step_size);
    REQUIRE(sample.contacts.size() == 1);
    // The fields tell the same forces node by node, on either side.
    const ContactState state = contact_state(model, model.ties, model.contacts, 0);
    double slave = 0, master = 0;
    std::vector<double> by_slave, by_master;
    for (std::size_t i = 0; i < state.slave.nodes.size(); ++i) {
      slave += state.slave.normal_force[3 * i + 2];
      by_slave.push_back(state.slave.normal_force[3 * i + 2]);
    }
    for (std::size_t i = 0; i < state.master.nodes.size(); ++i) {
      master += state.master.normal_force[3 * i + 2];
      by_master.push_back(-state.master.normal_force[3 * i + 2]);
    }
    CHECK_THAT(slave, WithinRel(totals.normal_force[2], 1e-10));
    CHECK_THAT(master, WithinRel(-totals.normal_force[2], 1e-10));
    const double reversed_share = std::fabs(contact_state(model, model.ties, model.contacts, 1).slave.normal_force[2]);
    WARN("upper " << upper[0] << ", lower " << lower[0]
                  << " elements across: largest over least nodal pressure on the slave "
                  << spread_of(by_slave, state.slave.area) << ", on the master "
                  << spread_of(by_master, state.master.area));
    CHECK(reversed_share > 0);
  }
}

TEST_CASE(
    "a symmetric contact lets a finer master enter a coarse slave no deeper than the springs need, a plain one does") {
  const auto deepest = [](bool symmetric) {
    Model model;
    build_resting(model, symmetric, {3, 3, 2}, {8, 8, 3});
    // The slave's faces stay bilinear between four nodes; measure the master's nodes against its mean plane.
    const auto x = to_host(model.nodes.position);
    double highest = -1, slave = 0;
    for (int n : model.contacts[0].master_nodes) highest = std::max(highest, x(n, 2));
    for (int n : model.contacts[0].slave_nodes)
      slave += x(n, 2) / static_cast<double>(model.contacts[0].slave_nodes.size());
    return highest - slave;
  };
  const double plain = deepest(false), both = deepest(true);
  WARN("the master's highest node above the slave's mean height: plain " << plain << " m, symmetric " << both << " m");
  CHECK(both < plain);
}

TEST_CASE("friction of a symmetric contact holds a pull up to mu N in all, and loses mu N times the way") {
  const double friction = 0.3;
  Model model;
  build_resting(model, true, {5, 5, 2}, {11, 6, 2}, friction);
  const auto& upper = model.assembly.node_sets.at("upper");
  const double start = mean(model, NodeField::displacement, upper)[0], mass = mass_of(model, "upper");
  std::vector<double> time, speed;
  double first = 0, imbalance = 0, way = 0;
  EnergyAccount last;
  march(model, model.step_count, [&] {
    if (model.step % 5 != 0 && model.step != model.step_count) return;
    time.push_back(model.time);
    speed.push_back(mean(model, NodeField::velocity, upper)[0]);
    way = mean(model, NodeField::displacement, upper)[0] - start;
    last = account_energies(model, model.step_size);
    if (model.step == 0) first = balance_total(last);
    imbalance = std::max(imbalance, std::fabs(balance_total(last) - first));
  });
  std::size_t a = 0;
  while (time[a] < 2.5e-4) ++a;
  const double acceleration = (speed.back() - speed[a]) / (time.back() - time[a]);
  INFO("acceleration " << acceleration << ", friction energy " << last.friction << ", way " << way << ", imbalance "
                       << imbalance);
  CHECK_THAT(acceleration, WithinRel(0.1 * friction * total_pressing() / mass, 0.02));
  CHECK_THAT(last.friction, WithinRel(friction * total_pressing() * way, 0.02));
  CHECK(imbalance < 0.01 * largest_energy(last));
}

TEST_CASE("a block in a corner presses on floor and wall with its two loads, though they share its edge's nodes") {
  TwoBlocks blocks;
  blocks.upper_size = {0.04, 0.04, 0.02};
  blocks.upper_divisions = {4, 4, 2};
  blocks.lower_divisions = {7, 7, 2};
  scene::Scene scene = blocks.scene(1e-3);
  scene.parts.push_back(scene.parts[1]);
  scene.parts[2].name = "wall";
  scene.parts[2].position = {-0.02 - 0.08, -0.04, -0.01};
  scene.contacts.push_back(scene.contacts[0]);
  scene.contacts[1].name = "side";
  scene.contacts[1].slave = "upper.x_min";
  scene.contacts[1].master = "wall.x_max";
  scene.time.step_scale = 0.6;
  for (scene::Part& part : scene.parts) part.hourglass = scene::HourglassType::stiffness;
  hold(scene, "lower.z_min", {true, true, true});
  hold(scene, "wall.x_min", {true, true, true});
  add_force(scene, "upper", {-2e4, 0, -3e4});
  scene.settle.active = true;
  scene.settle.tolerance = 1e-5;
  Model model;
  build_model(scene, model);
  REQUIRE(settle_whole(model).settled);
  std::vector<int> on_both;
  std::set_intersection(model.contacts[0].slave_nodes.begin(), model.contacts[0].slave_nodes.end(),
                        model.contacts[1].slave_nodes.begin(), model.contacts[1].slave_nodes.end(),
                        std::back_inserter(on_both));
  REQUIRE(on_both.size() == 5);
  march(model, 500, [&] {
    if (model.step % 50 != 0) return;
    const ContactTotals floor = contact_totals(model, model.contacts, 0),
                        wall = contact_totals(model, model.contacts, 1);
    CHECK_THAT(floor.normal_force[2], WithinRel(3e4, 2e-3));
    CHECK_THAT(wall.normal_force[0], WithinRel(2e4, 2e-3));
    CHECK(reaction_error(floor) < 1e-12);
    CHECK(reaction_error(wall) < 1e-12);
  });
}

TEST_CASE("the step counts the springs of all pairs on a node") {
  const auto step = [](int times, bool symmetric) {
    TwoBlocks blocks;
    blocks.upper_size = blocks.lower_size = {0.01, 0.01, 0.01};
    blocks.upper_divisions = blocks.lower_divisions = {10, 10, 10};
    scene::Scene scene = blocks.scene(1e-3);
    for (int k = 1; k < times; ++k) {
      scene.contacts.push_back(scene.contacts[0]);
      scene.contacts.back().name += std::to_string(k);
    }
    scene.contacts[0].symmetric = symmetric;
    Model model;
    build_model(scene, model);
    return model.stable_step.contact;
  };
  // Halves of a symmetric contact add up to the plain one; a second pair on the same nodes doubles the springs.
  CHECK_THAT(step(1, true), WithinRel(step(1, false), 1e-9));
  CHECK(step(2, false) < 0.85 * step(1, false));
}
