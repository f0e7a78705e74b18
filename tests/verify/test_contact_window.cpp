#include <catch2/catch_test_macros.hpp>

#include "solve/tasks.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// Positions, velocities and contact forces at the end of a run, with the window built when it needs to be or every
/// step.
std::vector<double> outcome(const scene::Scene& scene, bool every_step, long& layouts) {
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  ContactPair& pair = model.contacts[0];
  march(model, model.step_count, [&] {
    if (!every_step) return;
    pair.next_check = -1;
    pair.slaves_at_layout = {};
  });
  layouts = pair.layouts;
  std::vector<double> values;
  for (NodeField field : {NodeField::position, NodeField::velocity, NodeField::acceleration}) {
    const auto part = node_field(model, model.ties, field, all_nodes(model)).values;
    values.insert(values.end(), part.begin(), part.end());
  }
  const auto energy = account_energies(model, model.step_size);
  values.insert(values.end(), {energy.contact, energy.friction, energy.kinetic});
  return values;
}

void check_window_is_unseen(const scene::Scene& scene) {
  long layouts, all;
  const auto own = outcome(scene, false, layouts), often = outcome(scene, true, all);
  std::size_t different = 0;
  for (std::size_t k = 0; k < own.size(); ++k) different += !(own[k] == often[k]);
  INFO("window built " << layouts << " times; values that differ: " << different << " of " << own.size());
  CHECK(different == 0);
}

/// Upper block small against the lower one, so that both surfaces' windows move.
TwoBlocks small_on_large() {
  TwoBlocks blocks;
  blocks.upper_size = {0.01, 0.01, 0.005};
  blocks.upper_divisions = {5, 4, 2};
  blocks.lower_size = {0.06, 0.03, 0.005};
  blocks.lower_divisions = {30, 16, 2};
  blocks.friction = 0.3;
  return blocks;
}

/// 18 mm, so that the window is built more than once.
scene::Scene sliding_impact(scene::ContactAlgorithm algorithm) {
  TwoBlocks blocks = small_on_large();
  blocks.algorithm = algorithm;
  blocks.gap = 1e-4;
  scene::Scene scene = blocks.scene(3e-4);
  add_motion(scene, {"upper"}, {60, 10, -8}, {0, 500, 100});
  return scene;
}

}  // namespace

TEST_CASE("how often the contact window is built changes no bit of an impact that slides") {
  check_window_is_unseen(sliding_impact(scene::ContactAlgorithm::penalty));
}

TEST_CASE("how often the contact window is built changes multipliers and their account by rounding alone") {
  // Multipliers take in nodes just before these touch, which a check finds at the same places but for rounding.
  long layouts, all;
  const scene::Scene scene = sliding_impact(scene::ContactAlgorithm::multiplier);
  const auto own = outcome(scene, false, layouts), often = outcome(scene, true, all);
  constexpr std::size_t energies = 3;
  const std::size_t components = (own.size() - energies) / 3;
  double moved = 0;
  for (std::size_t k = 0; k < components; ++k) moved = std::max(moved, std::fabs(own[k] - often[k]));
  CHECK(moved < 1e-14);
  for (std::size_t k = own.size() - energies; k < own.size(); ++k) {
    INFO("energy " << own[k] << " J, otherwise " << often[k]);
    CHECK(std::fabs(own[k]) > 1e-3);
    CHECK(std::fabs(own[k] - often[k]) < 1e-9 * std::fabs(own[k]));
  }
}

TEST_CASE("how often the contact window is built changes no bit when a body at rest is set in motion late") {
  // At rest until 4e-5 s (some 200 steps), then driven across the lower block and onto it.
  for (double gap : {0.0, 9e-3}) {
    TwoBlocks blocks = small_on_large();
    blocks.gap = gap;
    scene::Scene scene = blocks.scene(4e-4);
    hold(scene, "lower.z_min", {true, true, true});
    add_ramp(scene, "late", 4e-5, 2e-5);
    const double mass = 7800 * 0.01 * 0.01 * 0.005;
    add_force(scene, "upper", (mass * (gap > 0 ? 3e5 : 4e5)) * Vec3{gap > 0 ? 0.1 : 1.0, 0, -1}, "late");
    check_window_is_unseen(scene);
  }
}

TEST_CASE("slaves outside the window are too far from every segment to touch it") {
  TwoBlocks blocks = small_on_large();
  blocks.gap = 1e-3;
  blocks.upper_size = {0.12, 0.01, 0.005};  // its ends hang over
  blocks.upper_divisions = {50, 5, 2};
  scene::Scene scene = blocks.scene(3e-4);
  // One end meets the lower block, the other rises.
  add_motion(scene, {"upper"}, {30, 0, -20}, {0, 800, 0});
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  const ContactPair& pair = model.contacts[0];
  double nearest = 1e300;
  int outside = 0, touching = 0;
  march(model, model.step_count, [&] {
    const auto window = to_host(pair.window.entries);
    std::vector<bool> inside(pair.slave_nodes.size(), false);
    for (int i = 0; i < pair.window.count; ++i) inside[window(i).slave] = true;
    const auto x = to_host(model.nodes.position);
    touching += contact_totals(model, model.contacts, 0).nodes_in_contact;
    for (std::size_t s = 0; s < inside.size(); ++s) {
      if (inside[s]) continue;
      ++outside;
      for (int m : pair.master_nodes) {
        double squared = 0;
        for (int i = 0; i < 3; ++i) squared += std::pow(x(pair.slave_nodes[s], i) - x(m, i), 2);
        nearest = std::min(nearest, std::sqrt(squared));
      }
    }
  });
  INFO("outside " << outside << ", nearest to a master node " << nearest / pair.segment_size << " segments");
  CHECK(outside > 0);
  CHECK(touching > 0);
  // Where a slave touches a segment, its nearest node is at most half a diagonal away.
  CHECK(nearest > 0.5 * pair.segment_size);
}

TEST_CASE("a check of the window that comes too late for a body set in motion at once is reported") {
  TwoBlocks blocks = small_on_large();
  blocks.gap = 2e-3;
  scene::Scene scene = blocks.scene(1e-3);
  Model model;
  build_model(scene, model);
  march(model, 10, [] {});
  CHECK(late_contacts(model.contacts).empty());
  // Nobody can foresee that; the next check finds the upper block inside the lower.
  set_velocity(model, [&](const Vec3& x, int) { return Vec3{0, 0, x[2] > 1e-3 ? -400.0 : 0}; });
  march(model, 120, [] {});
  const auto lines = late_contacts(model.contacts);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].find("steps late") != std::string::npos);
}

TEST_CASE("near nodes that rest between two checks are looked at before they can touch") {
  if (on_device) SKIP("on a GPU no node rests");
  // Half a millimetre is near, and far enough to rest; a body comes down on it as fast as waves of small strain.
  TwoBlocks blocks = small_on_large();
  blocks.gap = 5e-4;
  scene::Scene scene = blocks.scene(3e-4);
  add_motion(scene, {"upper"}, {30, 5, -4}, {0, 200, 100});
  check_window_is_unseen(scene);

  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  const ContactPair& pair = model.contacts[0];
  int rested = 0, touched = 0;
  march(model, model.step_count, [&] {
    const auto entries = to_host(pair.window.entries);
    for (int i = 0; i < pair.window.count; ++i) rested += entries(i).rests > 0;
    touched += contact_totals(model, model.contacts, 0).nodes_in_contact;
  });
  CHECK(rested > 0);
  CHECK(touched > 0);
  CHECK(late_contacts(model.contacts).empty());
}

TEST_CASE("nodes rest on after a checkpoint, which has no boxes, and gaps are the same") {
  TwoBlocks blocks = small_on_large();
  blocks.gap = 5e-4;
  scene::Scene scene = blocks.scene(3e-4);
  add_motion(scene, {"upper"}, {30, 5, -4}, {0, 200, 100});
  const auto states = [&](bool taken_up) {
    Model model;
    build_model(scene, model);
    set_initial_motion(model, model.nodes, model.beams);
    march(model, 20, [] {});  // amid two checks
    if (taken_up) model.contacts[0].boxed = false;
    std::vector<int> state;
    std::vector<double> gaps;
    march(model, 30, [&] {
      const auto entries = to_host(model.contacts[0].window.entries);
      for (int i = 0; i < model.contacts[0].window.count; ++i) state.push_back(entries(i).projected());
      const auto now = contact_state(model, model.ties, model.contacts, 0).gap;
      gaps.insert(gaps.end(), now.begin(), now.end());
    });
    for (double& gap : gaps)
      if (!(gap < 1)) gap = 1;
    return std::pair(state, gaps);
  };
  CHECK(states(false) == states(true));
}

TEST_CASE("a shock that meets near nodes while they rest makes them late, not lost") {
  if (on_device) SKIP("on a GPU no node rests");
  TwoBlocks blocks = small_on_large();
  blocks.gap = 5e-4;
  scene::Scene scene = blocks.scene(1e-3);
  Model model;
  build_model(scene, model);
  march(model, 4, [] {});
  set_velocity(model, [&](const Vec3& x, int) { return Vec3{0, 0, x[2] > 1e-4 ? -60.0 : 0}; });
  int touched = 0;
  march(model, 60, [&] { touched += contact_totals(model, model.contacts, 0).nodes_in_contact; });
  CHECK(touched > 0);
  for (const std::string& line : late_contacts(model.contacts)) CHECK(line.find("steps late") != std::string::npos);
}

TEST_CASE("launches over a contact's window keep their size while its nodes come and go") {
  ContactWindow window;
  window.resize(1000);
  const int bound = window.bound();
  CHECK(bound >= 1000);
  for (int nodes : {900, 0, 1100, 1000}) {
    window.resize(nodes);
    CHECK(window.count == nodes);
    CHECK(window.bound() == bound);
  }
  window.resize(5000);
  CHECK(window.bound() >= 5000);
  ContactWindow taken_up;  // a state gives the number alone
  taken_up.count = 700;
  CHECK(taken_up.bound() >= 700);
}
