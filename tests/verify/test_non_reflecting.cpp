#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "benchmarks/problems/rayleigh_packet.hpp"
#include "case/error.hpp"
#include "tests/verify/open_ends.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

/// What moves and deforms.
double waves_energy(const Model& model) {
  const EnergyAccount energy = account_energies(model, model.step_size);
  return energy.kinetic + energy.internal + energy.hourglass;
}

/// A bar along x with a Gaussian pulse on its way to the open end.
struct Bar {
  double length = 0.4, width = 0.01, deviation = 0.02;
  int layers = 80, across = 1;
  int moved = 0;     ///< 0: the pulse presses along the bar, 1: it shears
  bool held = true;  ///< across the pulse's motion: plane waves
  double step_scale = 0.9;
  scene::Precision precision = scene::Precision::double_precision;

  double speed(const scene::Material& m) const {
    if (moved == 1) return m.shear_speed();
    return held ? m.dilatational_speed() : std::sqrt(m.youngs_modulus / m.density);
  }

  scene::Scene scene() const {
    scene::Scene made = block_scene({length, width, width}, {layers, across, across}, 1);
    set_hourglass(made.parts[0], scene::HourglassType::stiffness, 0.05);
    made.time.end = length / speed(made.materials[0]);
    made.time.step_scale = step_scale;
    made.solver.precision = precision;
    if (held) hold(made, "block", {moved != 0, moved != 1, true});
    add_dashpots(made, "block.x_max");
    return made;
  }

  /// Puts the pulse in the middle.
  void start(Model& model) const {
    const double c = speed(model.scene.materials[0]), amplitude = 1e-6;
    const auto shape = [&](double x) {
      return amplitude * std::exp(-0.5 * std::pow((x - 0.5 * length) / deviation, 2));
    };
    const auto slope = [&](double x) { return -(x - 0.5 * length) / (deviation * deviation) * shape(x); };
    const auto bend = [&](double x) {
      return (std::pow((x - 0.5 * length) / deviation, 2) - 1) / (deviation * deviation) * shape(x);
    };
    // A bar that is free to do so gets thinner where it is stretched.
    const double thinning = held ? 0 : model.scene.materials[0].poissons_ratio;
    set_position(model, [&](const Vec3& x, int) {
      Vec3 place = x;
      place[moved] += shape(x[0]);
      for (int i : {1, 2}) place[i] -= thinning * slope(x[0]) * (x[i] - 0.5 * width);
      return place;
    });
    set_velocity(model, [&](const Vec3& x, int) {
      Vec3 v{};
      v[moved] = -c * slope(x[0]);
      for (int i : {1, 2}) v[i] += thinning * c * bend(x[0]) * (x[i] - 0.5 * width);
      return v;
    });
  }

  /// Share of the pulse's energy that has stayed when all of it should have left.
  double reflected() const {
    Model model;
    build_model(scene(), model);
    start(model);
    double first = -1, least = 1e300;
    march(model, model.step_count, [&] {
      const double now = waves_energy(model);
      if (first < 0) first = now;
      least = std::fmin(least, now);
    });
    return waves_energy(model) / first;
  }
};

}  // namespace

TEST_CASE("a P pulse leaves a non-reflecting end at normal incidence with less than 1 % of its energy thrown back") {
  for (auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
    Bar bar;
    bar.precision = precision;
    const double share = bar.reflected();
    UNSCOPED_INFO("precision " << static_cast<int>(precision) << ": reflected " << share);
    CHECK(share < 1e-3);
  }
}

TEST_CASE("so does a shear pulse, and one of a thin bar as far as its speed is not the P wave's") {
  Bar shear;
  shear.moved = 1;
  const double sheared = shear.reflected();
  UNSCOPED_INFO("shear: reflected " << sheared);
  CHECK(sheared < 1e-3);
  Bar thin;
  thin.held = false;
  thin.length = 0.8;
  thin.deviation = 0.05;
  thin.layers = 160;
  thin.across = 2;
  thin.step_scale = 0.6;
  const double c = steel().dilatational_speed(), bar = std::sqrt(steel().youngs_modulus / steel().density);
  const double theory = std::pow((c - bar) / (c + bar), 2), found = thin.reflected();
  UNSCOPED_INFO("thin bar: reflected " << found << ", by the impedances " << theory);
  CHECK(found < 1e-2);
  CHECK_THAT(found, WithinRel(theory, 0.2));
}

TEST_CASE("a Rayleigh pulse runs out of a block's side") {
  const double length = 0.08, depth = 0.05, wavelength = 0.01, size = 0.001;
  scene::Scene scene = block_scene({length, size, depth}, {80, 1, 50}, 1);
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  hold(scene, "block", {false, true, false});
  for (const char* side : {"block.x_min", "block.x_max", "block.z_min"}) add_dashpots(scene, side);
  const bench::RayleighPacket packet(scene.materials[0], wavelength, 0.8 * wavelength);
  const double from = 0.04, amplitude = 1e-6;
  scene.time.end = 0.068 / packet.speed;
  Model model;
  build_model(scene, model);
  set_position(model, [&](const Vec3& x, int) {
    const Vec3 u = packet.displacement(x[0] - from, depth - x[2]);
    return x + amplitude * u;
  });
  set_velocity(
      model, [&](const Vec3& x, int) { return (-packet.speed * amplitude) * packet.slope(x[0] - from, depth - x[2]); });
  double first = -1;
  march(model, model.step_count, [&] {
    if (first < 0) first = waves_energy(model);
  });
  const double share = waves_energy(model) / first;
  UNSCOPED_INFO("Rayleigh: reflected " << share);
  CHECK(share < 0.05);
}

TEST_CASE("dashpots of a non-reflecting end do not bear on the stable step, and their energy is in the account") {
  Bar bar;
  bar.across = 2;
  bar.held = false;
  scene::Scene scene = bar.scene();
  scene.time.step_scale = 1;
  scene.solver.step_estimate = scene::StepEstimate::global;
  scene.solver.renew_steps = 0;
  scene.output.history_interval = scene.time.end / 100;
  scene::Scene closed = scene;
  closed.non_reflecting.clear();
  Model model, other;
  build_model(scene, model);
  build_model(closed, other);
  CHECK(model.step_size == other.step_size);
  bar.start(model);
  Recorder recorder;
  run(model, {&recorder});
  const EnergyAccount &first = recorder.samples.front().energy, &last = recorder.samples.back().energy;
  CHECK(last.damping > 0.98 * (first.kinetic + first.internal));
  double worst = 0;
  for (const HistorySample& sample : recorder.samples) worst = std::fmax(worst, std::fabs(sample.energy.balance_error));
  UNSCOPED_INFO("worst imbalance " << worst << " J of " << first.kinetic << " J");
  CHECK(worst < 1e-3 * first.kinetic);
  // Long after, nothing has grown.
  march(model, 3000, [] {});
  CHECK(waves_energy(model) < 0.02 * first.kinetic);
}

TEST_CASE("a bar whose coarse half has steps of its own lets the pulse out as well") {
  Bar bar;
  scene::Scene scene = bar.scene();
  scene.solver.subcycling = true;
  Assembly assembly = assemble(scene);
  // Half as long elements in the first quarter: the end's own elements go at the double step.
  for (Vec3& x : assembly.nodes) x[0] = x[0] < 0.1 ? 0.35 * x[0] : x[0] - 0.065;
  Model model;
  build_model(scene, assembly, model);
  REQUIRE(model.subcycling.levels > 1);
  const auto levels = to_host(model.subcycling.node_levels.level);
  CHECK(static_cast<int>(levels(model.ends.nodes[0])) > 0);
  bar.start(model);
  double first = -1;
  march(model, model.step_count, [&] {
    if (first < 0) first = waves_energy(model);
  });
  const double share = waves_energy(model) / first;
  UNSCOPED_INFO("reflected " << share);
  CHECK(share < 1e-2);
}

namespace {

/// A block between two open ends, pulled and sheared at its top by forces that its ends hold.
scene::Scene loaded_block(double end, bool layers) {
  scene::Scene scene = block_scene({0.2, 0.05, 0.05}, {16, 4, 4}, end);
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  for (const char* side : {"block.x_min", "block.x_max"}) {
    add_dashpots(scene, side);
    if (layers) add_layer(scene, side, 0.08, 0.1);
  }
  add_force(scene, "block.z_max", {2e4, 5e3, -1e4});
  scene.settle.active = true;
  scene.settle.tolerance = 1e-7;
  scene.settle.max_steps = 100000;
  return scene;
}

/// Total of what the ends' supports and dashpots do.
Vec3 reaction(const Model& model) {
  const auto support = to_host(model.ends.arrays.support), force = to_host(model.ends.arrays.force);
  Vec3 sum{};
  for (int k = 0; k < model.ends.arrays.count; ++k)
    for (int i = 0; i < 3; ++i) sum[i] += support(k, i) + force(k, i);
  return sum;
}

void check_reaction(double end, bool layers = false) {
  Model model;
  build_model(loaded_block(end, layers), model);
  CHECK(settle_whole(model).settled);
  const Vec3 applied{2e4, 5e3, -1e4};
  const auto nodes = all_nodes(model);
  const auto settled = node_field(model, model.ties, NodeField::position, nodes).values;
  double worst = 0;
  march(model, model.step_count, [&] { worst = std::fmax(worst, norm(reaction(model) + applied) / norm(applied)); });
  double moved = 0;
  const auto now = node_field(model, model.ties, NodeField::position, nodes).values;
  for (std::size_t k = 0; k < now.size(); ++k) moved = std::fmax(moved, std::fabs(now[k] - settled[k]));
  UNSCOPED_INFO("reaction off by " << worst << " of the load, nodes moved by " << moved << " m in " << model.step_count
                                   << " steps");
  CHECK(worst < 5e-3);
  CHECK(moved < 1e-7);
}

}  // namespace

TEST_CASE("non-reflecting ends hold the static load: 1 ms") { check_reaction(1e-3); }

TEST_CASE("so do they with absorbing layers before them") { check_reaction(1e-3, true); }

TEST_CASE("non-reflecting ends hold the static load: 50 ms", "[long]") { check_reaction(50e-3); }

TEST_CASE("without settling ends hold nothing: a load pushes them away at force over impedance") {
  Bar bar;
  scene::Scene scene = bar.scene();
  scene.time.end = 1e-3;
  add_force(scene, "block.x_max", {100, 0, 0});
  Model model;
  build_model(scene, model);
  march(model, model.step_count, [] {});
  const double impedance = 7800 * steel().dilatational_speed() * bar.width * bar.width;
  CHECK_THAT(mean(model, NodeField::velocity, all_nodes(model))[0], WithinRel(100 / impedance, 1e-3));
}

TEST_CASE("a scene without non-reflecting ends computes none, and what cannot be one is refused") {
  const auto task_names = [](const scene::Scene& scene) {
    Model model;
    build_model(scene, model);
    std::string names;
    for (const Task& task : make_plan(model, StepKind::advancing).forces) names += task.name + "\n";
    return names;
  };
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  CHECK_THAT(task_names(scene), !ContainsSubstring("non-reflecting"));
  add_dashpots(scene, "block.x_max");
  CHECK_THAT(task_names(scene), ContainsSubstring("non-reflecting ends"));
  const auto complaint = [&] { return complaint_of_building(scene); };
  SECTION("twice") {
    add_dashpots(scene, "block.x_max");
    CHECK_THAT(complaint(), ContainsSubstring("name surfaces without common faces"));
  }
  SECTION("moved") {
    scene::PrescribedMotion motion;
    motion.name = "driven";
    motion.target = "block.z_min";
    scene.prescribed_motions.push_back(motion);
    CHECK_THAT(complaint(), ContainsSubstring("moves as [prescribed_motion.driven] says"));
  }
}
