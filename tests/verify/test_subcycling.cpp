#include <catch2/catch_test_macros.hpp>

#include "tests/verify/graded_bar.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

struct PulseRun {
  double error = 0, gain = 0;
};

/// A pulse that has run from one coarse end through the fine middle into the other: error of the displacement against
/// the exact one, over the exact one, in the mean square.
PulseRun pulse_run(double width, scene::Precision precision, bool subcycling) {
  GradedBar bar(40, 30, 1);
  const Pulse pulse{width, 1e-6, 5 * width, bar.wave_speed()};
  const double path = bar.length() - 10 * width;
  bar.scene.time.end = path / bar.wave_speed();
  bar.scene.solver.precision = precision;
  hold(bar.scene, "block", {false, true, true});
  Model model;
  bar.build(model, subcycling);
  pulse.set(model);
  run(model, {});
  const auto nodes = all_nodes(model);
  const auto u = node_field(model, model.ties, NodeField::displacement, nodes).values;
  double error = 0, exactly = 0;
  for (int n : nodes) {
    const double exact = pulse.displacement(model.assembly.nodes[n][0] - path);
    error += model.mass[n] * (u[3 * n] - exact) * (u[3 * n] - exact);
    exactly += model.mass[n] * exact * exact;
  }
  return {std::sqrt(error / exactly), model.subcycling.gain()};
}

Vec3 momentum(const Model& model) {
  const auto v = node_field(model, model.ties, NodeField::velocity, all_nodes(model)).values;
  Vec3 sum{};
  for (int n = 0; n < model.nodes.count; ++n) sum = sum + model.mass[n] * Vec3{v[3 * n], v[3 * n + 1], v[3 * n + 2]};
  return sum;
}

}  // namespace

TEST_CASE(
    "a pulse through a mesh graded from 30 mm to 1 mm and back is as exact with subcycling, for half the updates or "
    "less") {
  for (const auto precision : {scene::Precision::double_precision, scene::Precision::mixed})
    for (double width : {0.06, 0.08, 0.12}) {
      const PulseRun plain = pulse_run(width, precision, false), subcycled = pulse_run(width, precision, true);
      INFO("pulse " << width << " m: error " << plain.error << " plain, " << subcycled.error << " subcycled; updates "
                    << subcycled.gain << " times fewer");
      CHECK(plain.gain == 1);
      CHECK(subcycled.gain > 2);
      CHECK(subcycled.error < 1.05 * plain.error);
      CHECK(plain.error < 0.5);
    }
}

TEST_CASE(
    "subcycling keeps the energy over 60 000 steps of free vibration in all modes, and the momentum to rounding") {
  for (double scale : {0.9, 0.8}) {
    GradedBar bar(6, 12, 1);
    bar.scene.time.step_scale = scale;
    bar.scene.time.end = 60000 * scale * 1e-3 / bar.wave_speed();
    bar.scene.output.history_interval = 320 * scale * 1e-3 / bar.wave_speed();
    Model model;
    bar.build(model, true);
    REQUIRE(model.subcycling.levels > 3);
    shake(model);
    const Vec3 before = momentum(model);
    Recorder recorder;
    run(model, {&recorder});
    CHECK(model.step >= 60000);
    CHECK(std::fabs(model.time / bar.scene.time.end - 1) < 1e-12);
    double first = 0, early = 0, late = 0, momentum_size = 0;
    const auto& samples = recorder.samples;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double total = balance_total(samples[k].energy);
      if (k == 0) first = total;
      double& worst = k < samples.size() / 4 ? early : late;
      worst = std::max(worst, std::fabs(total / first - 1));
    }
    for (int n = 0; n < model.nodes.count; ++n) momentum_size += 0.01 * model.mass[n];
    INFO("step scale " << scale << ": energy off by " << early << " in the first quarter, " << late << " later");
    CHECK(early < 0.05);
    CHECK(late < 1.5 * early);
    CHECK(norm(momentum(model) - before) < 1e-11 * momentum_size);
  }
}

TEST_CASE("a coarse region one element thick, which heights call stable with its level's step, keeps its energy") {
  // Sizes that a sixteenfold step just reached by heights.
  for (double largest : {17.4e-3, 17.8e-3}) {
    GradedBar bar(12, 12, 1, 1, largest);
    bar.scene.time.step_scale = 0.95;
    bar.scene.time.end = 16000 * 0.95e-3 / bar.wave_speed();
    Model model;
    bar.build(model, true);
    REQUIRE(model.subcycling.levels > 2);
    shake(model);
    Recorder recorder;
    run(model, {&recorder});
    const double first = balance_total(recorder.samples.front().energy),
                 last = balance_total(recorder.samples.back().energy);
    INFO("cubes of " << largest << " m at the ends: " << model.subcycling.levels << " levels, energy " << last / first
                     << " of what it was");
    CHECK(std::fabs(last / first - 1) < 0.05);
    CHECK(recorder.samples.back().step >= 10000);
  }
}

TEST_CASE("sampling every cycle changes nothing, nor does computing at nodes what blocks could") {
  GradedBar bar(4, 12, 1);
  bar.scene.time.end = 640 * 0.9e-3 / bar.wave_speed();
  Model one, other;
  for (Model* model : {&one, &other}) {
    bar.build(*model, true);
    shake(*model);
  }
  run(one, {});
  march(other, other.step_count, [] {});
  const auto nodes = all_nodes(one);
  const auto a = node_field(one, one.ties, NodeField::displacement, nodes).values,
             b = node_field(other, other.ties, NodeField::displacement, nodes).values;
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::fabs(a[i] - b[i]));
    largest = std::max(largest, std::fabs(a[i]));
  }
  CHECK(largest > 0);
  CHECK(difference < 1e-9 * largest);
}

TEST_CASE("a scene of one level runs as without subcycling, bit for bit") {
  scene::Scene scene = block_scene({0.04, 0.04, 0.04}, {4, 4, 4}, 2e-5);
  std::vector<double> result[2];
  for (bool subcycling : {false, true}) {
    scene.solver.subcycling = subcycling;
    Model model;
    build_model(scene, model);
    CHECK(model.subcycling.levels == 1);
    shake(model);
    run(model, {});
    result[subcycling ? 1 : 0] = node_field(model, model.ties, NodeField::displacement, all_nodes(model)).values;
  }
  CHECK(result[0] == result[1]);
}

TEST_CASE("surfaces in contact are of one level, their nodes of the finest") {
  TwoBlocks blocks;
  blocks.lower_size = {0.3, 0.3, 0.2};
  blocks.lower_divisions = {10, 10, 7};
  blocks.upper_divisions = {16, 16, 4};
  scene::Scene scene = blocks.scene(1e-4);
  scene.solver.subcycling = true;
  Model model;
  build_model(scene, model);
  REQUIRE(model.subcycling.levels > 1);
  const auto level = to_host(model.subcycling.node_levels.level);
  for (const auto* nodes : {&model.contacts[0].slave_nodes, &model.contacts[0].master_nodes})
    for (int n : *nodes) CHECK(level(n) == 0);
  std::vector<int> of_element(model.assembly.elements.size());
  for (const ElementGroup& group : model.elements)
    for (std::size_t p = 0; p < group.first_element.size(); ++p)
      for (int e = 0; e < group.element_count[p]; ++e) of_element[group.first_element[p] + e] = group.level;
  for (const Face& face : model.assembly.surfaces.at("lower.z_max")) CHECK(of_element[face.element] == 0);
}
