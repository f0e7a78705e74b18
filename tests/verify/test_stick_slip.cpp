#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

/// A block on a spring, dragged by a belt, under friction that falls with the sliding speed (thesis eq. 2.29, with the
/// coefficients of its section 5.3.2.3), at once and with memory, by springs and by multipliers.
using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

struct Dragged {
  double mass = 7800 * 0.08 * 0.08 * 0.02, spring = 1e7, pressing = 2e4, belt = 0.3;  // kg, N/m, N, m/s
  double at_rest = 0.5, at_speed = 0.32, decay = 6;
  double memory = 0;  // s
  scene::ContactAlgorithm algorithm = scene::ContactAlgorithm::penalty;

  double friction(double speed) const { return at_speed + (at_rest - at_speed) * std::exp(-decay * speed); }

  struct Cycle {
    double period, farthest;  ///< s from one slip to the next, m
  };

  /// Of the one mass: slips by Heun's formula in steps of 10 ns, from the second slip to the third. Without memory each
  /// begins alike.
  Cycle exact() const {
    double x = at_rest * pressing / spring, v = belt, seen = 0, time = 0;
    const auto pull = [&](double at, double speed) { return (friction(speed) * pressing - spring * at) / mass; };
    const auto forgets = [&](double sliding, double remembered) { return (sliding - remembered) / memory; };
    double began[3] = {}, farthest = x;
    for (double& begin : began) {
      begin = time;
      const double dt = 1e-8;
      do {
        const double now = memory > 0 ? seen : belt - v, a1 = pull(x, now);
        const double s1 = memory > 0 ? forgets(belt - v, seen) : 0;
        const double v2 = v + dt * a1, then = memory > 0 ? seen + dt * s1 : belt - v2, a2 = pull(x + dt * v, then);
        x += 0.5 * dt * (v + v2);
        if (memory > 0) seen += 0.5 * dt * (s1 + forgets(belt - v2, then));
        v += 0.5 * dt * (a1 + a2);
        time += dt;
        farthest = std::max(farthest, x);
      } while (v < belt);
      v = belt;
      const double rest = 1e-7;
      for (; spring * x < friction(seen) * pressing; time += rest) {
        x += rest * belt;
        seen = memory > 0 ? seen * std::exp(-rest / memory) : 0;
      }
    }
    return {began[2] - began[1], farthest};
  }

  scene::Scene scene(double end) const {
    TwoBlocks blocks;
    blocks.upper_size = {0.08, 0.08, 0.02};
    blocks.upper_divisions = {2, 2, 1};
    blocks.lower_size = {0.2, 0.12, 0.02};
    blocks.lower_divisions = {7, 4, 1};
    blocks.friction = at_rest;
    scene::Scene made = blocks.scene(end);
    made.contacts[0].dynamic_friction = at_speed;
    made.contacts[0].friction_decay = decay;
    made.contacts[0].friction_memory = memory;
    made.contacts[0].algorithm = algorithm;
    made.time.step_scale = 0.6;
    // Without springs between, a block would rattle on the belt.
    if (algorithm == scene::ContactAlgorithm::multiplier)
      for (scene::Part& part : made.parts) part.stiffness_damping = 1e-6;
    scene::PrescribedMotion moving;
    moving.name = "belt";
    moving.target = "lower";
    moving.velocity = {belt, 0, 0};
    made.prescribed_motions.push_back(moving);
    add_force(made, "upper", {0, 0, -pressing});
    // At the belt: above it the pull would lean on the front edge, which then creeps first.
    add_spring(made, "ground", "upper.z_min", {spring, 0, 0});
    made.settle.active = true;
    made.settle.tolerance = 1e-6;
    made.output.history_sets = {"upper"};
    made.output.history_interval = 5e-6;
    return made;
  }
};

}  // namespace

TEST_CASE("a block on a spring dragged by a belt sticks and slips with the period of the exact equation") {
  Dragged dragged;
  dragged.memory = GENERATE(0.0, 4e-4);
  dragged.algorithm = GENERATE(scene::ContactAlgorithm::penalty, scene::ContactAlgorithm::multiplier);
  const auto exact = dragged.exact();
  Model model;
  build_model(dragged.scene(7 * exact.period), model);
  Recorder recorder;
  const RunSummary summary = run(model, {&recorder});
  INFO(summary.reason);
  REQUIRE(summary.completed);

  // Slips: where the spring's force falls through the dynamic friction's.
  const double level = dragged.at_speed * dragged.pressing / dragged.spring;
  std::vector<double> slips;
  double farthest = 0;
  for (std::size_t k = 1; k < recorder.samples.size(); ++k) {
    const auto &a = recorder.samples[k - 1], &b = recorder.samples[k];
    const double before = a.sets[0].displacement[0], now = b.sets[0].displacement[0];
    farthest = std::max(farthest, now);
    if (before > level && now <= level) slips.push_back(a.time + (b.time - a.time) * (before - level) / (before - now));
  }
  REQUIRE(slips.size() >= 4);
  const double period = (slips.back() - slips[1]) / static_cast<double>(slips.size() - 2);
  WARN("memory " << dragged.memory << " s, stick-slip period " << period << " s, exact " << exact.period << " s ("
                 << 100 * (period / exact.period - 1) << " %), slips " << slips.size() << ", farthest " << farthest
                 << " m, exact " << exact.farthest << " m, steps " << model.step);
  CHECK_THAT(period, WithinRel(exact.period, 0.02));
  CHECK_THAT(farthest, WithinRel(exact.farthest, 0.02));
}

TEST_CASE("the coefficient written beside the forces is that of the instant, and bounds them to rounding") {
  Dragged dragged;
  dragged.algorithm = GENERATE(scene::ContactAlgorithm::penalty, scene::ContactAlgorithm::multiplier);
  Model model;
  build_model(dragged.scene(2 * dragged.exact().period), model);
  REQUIRE(settle_whole(model).settled);
  set_initial_motion(model, model.nodes, model.beams);
  double lowest = 1, highest = 0, largest = 0, least_slipping = 1, worst = 0;
  std::vector<double> place, held, coefficient;
  std::vector<int> before;
  march(model, model.step_count, [&] {
    // How far each slave has moved over the belt since the instant before, from positions alone: the belt is plane.
    const auto x = to_host(model.nodes.position);
    const ContactPair& pair = model.contacts[0];
    std::vector<double> now;
    for (int n : pair.slave_nodes)
      for (int i : {0, 1}) now.push_back(x(n, i) - (i == 0 ? dragged.belt * model.step * model.step_size : 0));
    const ContactState state = contact_state(model, model.ties, model.contacts, 0);
    REQUIRE(state.friction_now.size() == pair.slave_nodes.size());
    const auto stiffness = to_host(pair.arrays.segment_stiffness);
    const auto tracked = to_host(pair.arrays.tracked);
    for (std::size_t s = 0; s < pair.slave_nodes.size() && !place.empty(); ++s) {
      if (state.slipping[s] == 0) continue;
      const double friction = state.friction_at(s);
      const double normal = norm(Vec3{state.slave.normal_force[3 * s], state.slave.normal_force[3 * s + 1],
                                      state.slave.normal_force[3 * s + 2]});
      const double along = now[2 * s] - place[2 * s], across = now[2 * s + 1] - place[2 * s + 1];
      double slid = 0;
      if (dragged.algorithm == scene::ContactAlgorithm::penalty) {
        // A spring takes up what it can hold at the coefficient of the instant before.
        const double k = stiffness(tracked(static_cast<int>(s)));
        const double trial = std::hypot(held[3 * s] - k * along, held[3 * s + 1] - k * across);
        slid = std::max(0.0, trial - coefficient[s] * normal) / k;
      } else if (before[s] == 2) {
        // What a node creeps that a multiplier holds is taken back.
        slid = std::hypot(along, across);
      }
      worst = std::max(worst, std::fabs(friction - dragged.friction(slid / model.step_size)));
      const double tangential = norm(Vec3{state.slave.tangential_force[3 * s], state.slave.tangential_force[3 * s + 1],
                                          state.slave.tangential_force[3 * s + 2]});
      const double used = tangential / (friction * normal);
      largest = std::max(largest, used);
      if (state.slipping[s] == 2) least_slipping = std::min(least_slipping, used);
      lowest = std::min(lowest, friction);
      highest = std::max(highest, friction);
    }
    place = now;
    before = state.slipping;
    held = state.slave.tangential_force;
    coefficient = state.friction_now;
  });
  INFO("coefficients " << lowest << " to " << highest << ", at most " << worst
                       << " from the law; tangential force at most " << largest << " of the bound, slipping at least "
                       << least_slipping);
  CHECK(lowest < dragged.at_speed + 0.01);
  CHECK(highest > dragged.at_rest - 1e-6);
  CHECK(worst < 1e-6);
  CHECK(largest < 1 + 1e-12);
  CHECK(least_slipping > 1 - 1e-12);
}
