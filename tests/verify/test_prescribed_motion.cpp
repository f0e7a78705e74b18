#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::PrescribedMotion motion(const std::string& target, const Vec3& velocity, const Vec3& angular_velocity) {
  scene::PrescribedMotion made;
  made.name = "driven";
  made.target = target;
  made.velocity = velocity;
  made.angular_velocity = angular_velocity;
  return made;
}

scene::Curve curve(std::vector<std::array<double, 2>> points) {
  scene::Curve made;
  made.name = "pace";
  made.type = scene::CurveType::table;
  made.points = std::move(points);
  return made;
}

}  // namespace

TEST_CASE("a set with a prescribed motion is where the rigid motion has it, after a whole turn too") {
  const double turns = 400;  // rad/s
  scene::Scene scene = block_scene({0.05, 0.05, 0.05}, {2, 2, 2}, 2 * M_PI / turns);
  const Vec3 axis = oblique_axes()[0];
  scene.prescribed_motions.push_back(motion("block.z_min", {3, 0, 1}, turns * axis));
  scene.prescribed_motions[0].centre = Vec3{0.1, 0, 0};
  Model model;
  build_model(scene, model);
  set_velocity(model, [&](const Vec3& x, int) { return Vec3{3, 0, 1} + turns * cross(axis, x - Vec3{0.1, 0, 0}); });
  const auto& nodes = model.assembly.node_sets.at("block.z_min");
  march(model, model.step_count / 4, [] {});
  const double t = model.time, c = std::cos(turns * t), s = std::sin(turns * t);
  const auto u = node_field(model, model.ties, NodeField::displacement, nodes).values;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 x = model.assembly.nodes[nodes[k]], r = x - Vec3{0.1, 0, 0};
    const Vec3 expected =
        Vec3{0.1, 0, 0} + t * Vec3{3, 0, 1} + c * r + s * cross(axis, r) + ((1 - c) * dot(axis, r)) * axis;
    for (int i = 0; i < 3; ++i) CHECK_THAT(x[i] + u[3 * k + i], WithinAbs(expected[i], 1e-14));
  }
  march(model, model.step_count - model.step, [] {});
  const auto at_end = node_field(model, model.ties, NodeField::displacement, nodes).values;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int i = 0; i < 3; ++i)
      CHECK_THAT(at_end[3 * k + i], WithinAbs(model.time * (i == 0 ? 3 : i == 1 ? 0 : 1), 1e-12));
}

TEST_CASE("the work of a prescribed motion is in the account: a bar stretched slowly, one shaken, and one turned") {
  scene::Scene scene = block_scene({0.02, 0.02, 0.1}, {2, 2, 10}, 3e-4);
  scene.constraints.emplace_back();
  scene.constraints[0].name = "foot";
  scene.constraints[0].target = "block.z_min";
  scene.constraints[0].fixed = {true, true, true};
  scene.output.history_interval = 5e-6;
  double least_work = 0;
  SECTION("stretched") {
    scene.curves.push_back(curve({{0, 0}, {1e-4, 1}, {2e-4, 0}}));
    scene.prescribed_motions.push_back(motion("block.z_max", {0, 0, 0.5}, {0, 0, 0}));  // 50 um in the end
    least_work = 0.5 * 210e9 * 4e-4 / 0.1 * 50e-6 * 50e-6;
  }
  SECTION("shaken") {
    scene.curves.push_back(curve({{0, 0}, {2e-5, 1}, {4e-5, -1}, {6e-5, 1}, {8e-5, -1}, {1e-4, 1}, {1.2e-4, 0}}));
    scene.prescribed_motions.push_back(motion("block.z_max", {1, 2, 3}, {0, 0, 0}));
    least_work = 0.1;
  }
  SECTION("twisted, at full speed from the first step") {
    scene.prescribed_motions.push_back(motion("block.z_max", {0, 0, 0}, {0, 0, 100}));
    least_work = 0.1;
  }
  if (!scene.curves.empty()) scene.prescribed_motions[0].curve = "pace";
  scene.parts[0].hourglass = scene::HourglassType::stiffness;
  scene.parts[0].hourglass_coefficient = 0.05;
  Model model;
  build_model(scene, model);
  Recorder recorder;
  run(model, {&recorder});
  double largest = 0, worst = 0;
  for (const HistorySample& sample : recorder.samples) {
    largest = std::max(largest, largest_energy(sample.energy));
    worst = std::max(worst, std::fabs(sample.energy.balance_error));
  }
  CHECK(recorder.samples.back().energy.external_work > least_work);
  INFO("worst imbalance " << worst << " J of " << largest << " J");
  CHECK(worst < 0.004 * largest);
}

TEST_CASE("a prescribed displacement is met at the end of every step, and other directions stay free") {
  scene::Scene scene = block_scene({0.05, 0.05, 0.05}, {2, 2, 2}, 3e-4);
  const auto axes = oblique_axes();
  add_ramp(scene, "ramp", 5e-5, 2e-4);
  // Both ends, so that the block follows without turning.
  for (const char* end : {"block.z_min", "block.z_max"}) {
    scene::PrescribedMotion moved = motion(end, {0, 0, 0}, {0, 0, 0});
    moved.name = end;
    moved.displacement = 2e-4 * axes[1];
    moved.displacement_curve = "ramp";
    moved.directions = {false, true, false};
    moved.axes = axes;
    scene.prescribed_motions.push_back(moved);
  }
  Model model;
  build_model(scene, model);
  const Vec3 drift = 3.0 * axes[0] + 2.0 * axes[2];
  set_velocity(model, [&](const Vec3&, int) { return drift; });
  double worst = 0, free_worst = 0;
  const auto& nodes = model.assembly.node_sets.at("block.z_max");
  march(model, model.step_count, [&] {
    const auto u = node_field(model, model.ties, NodeField::displacement, nodes).values;
    const double wanted = 2e-4 * curve_value(&model.scene.curves[0], model.time);
    Vec3 sum{};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec3 own{u[3 * k], u[3 * k + 1], u[3 * k + 2]};
      worst = std::max(worst, std::fabs(dot(axes[1], own) - wanted));
      sum = sum + own;
    }
    const Vec3 whole = mean(model, NodeField::displacement, all_nodes(model)) - model.time * drift;
    for (int a : {0, 2}) free_worst = std::max(free_worst, std::fabs(dot(axes[a], whole)));
  });
  INFO("off the curve by " << worst << " m, free directions by " << free_worst << " m");
  CHECK(worst < 1e-16);
  // Nothing pushes the block along the other axes: its momentum there stays, to rounding of places of 0.05 m in 200
  // steps.
  CHECK(free_worst < 1e-14);
  CHECK_THAT(dot(axes[1], mean(model, NodeField::displacement, nodes)), WithinAbs(2e-4, 1e-16));
}

TEST_CASE("a bar pulled along one direction by a displacement is free to thin, and its work is what theory says") {
  scene::Scene scene = block_scene({0.02, 0.02, 0.1}, {2, 2, 10}, 6e-4);
  hold(scene, "block.z_min", {false, false, true});
  scene.curves.push_back(curve({{0, 0}, {3e-4, 1}}));
  scene.prescribed_motions.push_back(motion("block.z_max", {0, 0, 0}, {0, 0, 0}));
  scene.prescribed_motions[0].displacement = {0, 0, 50e-6};
  scene.prescribed_motions[0].displacement_curve = "pace";
  scene.prescribed_motions[0].directions = {false, false, true};
  scene.parts[0].hourglass = scene::HourglassType::stiffness;
  scene.parts[0].hourglass_coefficient = 0.05;
  scene.parts[0].mass_damping = 4e4;  // calms the bar within the run
  scene.output.history_interval = 1e-5;
  Model model;
  build_model(scene, model);
  Recorder recorder;
  run(model, {&recorder});
  const HistorySample& last = recorder.samples.back();
  const double stretch = 0.5 * 210e9 * 4e-4 / 0.1 * 50e-6 * 50e-6;
  INFO("internal " << last.energy.internal << " J, theory " << stretch << " J, damping " << last.energy.damping
                   << " J, work " << last.energy.external_work << " J");
  // Uniaxial stress: were the end held across too, the energy would be larger by some per cent.
  CHECK_THAT(last.energy.internal, WithinRel(stretch, 0.005));
  CHECK(std::fabs(last.energy.balance_error) < 0.004 * last.energy.external_work);
}

TEST_CASE("a displacement that begins with a jump is refused") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  scene.curves.push_back(curve({{0, 0.5}, {1e-5, 1}}));
  scene.prescribed_motions.push_back(motion("block.z_min", {0, 0, 0}, {0, 0, 0}));
  scene.prescribed_motions[0].displacement = {1e-3, 0, 0};
  scene.prescribed_motions[0].displacement_curve = "pace";
  CHECK_THAT(complaint_of_building(scene),
             ContainsSubstring("[prescribed_motion.driven] displacement_curve: 'pace' is 0.5 at t = 0"));
}

TEST_CASE("a set with a prescribed motion is held while the scene settles") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  scene.gravity = {0, 0, -9.81};
  scene.settle.active = true;
  scene.prescribed_motions.push_back(motion("block.z_min", {5, 0, 0}, {0, 0, 0}));
  Model model;
  build_model(scene, model);
  settle_whole(model);
  for (double u :
       node_field(model, model.ties, NodeField::displacement, model.assembly.node_sets.at("block.z_min")).values)
    CHECK(u == 0);
  CHECK(mean(model, NodeField::displacement, model.assembly.node_sets.at("block.z_max"))[2] < 0);
}

TEST_CASE("a node has one prescribed motion, and methods that cannot prescribe one say so") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  scene.prescribed_motions.push_back(motion("block.z_min", {5, 0, 0}, {0, 0, 0}));
  const auto complaint = [&] { return complaint_of_building(scene); };
  CHECK(complaint().empty());
  SECTION("twice") {
    scene.prescribed_motions.push_back(motion("block.x_min", {5, 0, 0}, {0, 0, 0}));
    CHECK_THAT(complaint(), ContainsSubstring("a node of 'block.x_min' has a prescribed motion already"));
  }
  SECTION("subcycling") {
    scene.solver.subcycling = true;
    CHECK_THAT(complaint(), ContainsSubstring("leave subcycling out"));
  }
  SECTION("single precision") {
    scene.solver.precision = scene::Precision::single_precision;
    CHECK_THAT(complaint(), ContainsSubstring("set precision to \"mixed\" or \"double\""));
  }
}
