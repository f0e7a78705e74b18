#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <tuple>

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

namespace {

/// A block whose foot is held and whose top two motions drive at once, along two of some axes: by a velocity and by a
/// displacement, each with a curve of its own.
struct TwiceDriven {
  scene::Scene scene;
  std::array<Vec3, 3> axes;

  /// @param velocity, displacement m/s and m, 0: held along that direction
  TwiceDriven(const std::array<Vec3, 3>& along, double velocity, double displacement) : axes(along) {
    scene = block_scene({0.04, 0.04, 0.08}, {4, 4, 8}, 8e-5);
    hold(scene, "block.z_min", {true, true, true});
    scene.curves.push_back(curve({{0, 0}, {2e-5, 1}, {4e-5, -0.5}, {8e-5, 0.5}}));
    add_ramp(scene, "ramp", 1e-5, 5e-5);
    scene.prescribed_motions = {motion("block.z_max", velocity * axes[0], {0, 0, 0}),
                                motion("block.z_max", {0, 0, 0}, {0, 0, 0})};
    scene::PrescribedMotion &first = scene.prescribed_motions[0], &second = scene.prescribed_motions[1];
    first.curve = "pace";
    first.directions = {true, false, false};
    second.name = "pulled";
    second.displacement = displacement * axes[2];
    second.displacement_curve = "ramp";
    second.directions = {false, false, true};
    first.axes = second.axes = axes;
    scene.output.history_interval = 2e-6;
    scene.output.history_sets = {"block.z_max"};
  }
};

/// Samples of a run and the nodes' displacements at its end.
struct RunResult {
  std::vector<HistorySample> samples;
  std::vector<double> displacement;
};

RunResult result_of(const scene::Scene& scene) {
  Model model;
  build_model(scene, model);
  Recorder recorder;
  run(model, {&recorder});
  return {recorder.samples, node_field(model, model.ties, NodeField::displacement, all_nodes(model)).values};
}

constexpr std::array<Vec3, 3> upright{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

}  // namespace

TEST_CASE("a block that two motions drive at once moves as the sum of the two alone, and each has its own work") {
  // Strains of 1e-6: what is not linear is 1e-6 of it. Rounding of places of 0.08 m is 1e-10 of 1e-7 m.
  constexpr double small = 1e-5;
  const double velocity = 2e-3, displacement = 1e-7;
  const RunResult both = result_of(TwiceDriven(upright, velocity, displacement).scene),
                  x = result_of(TwiceDriven(upright, velocity, 0).scene),
                  z = result_of(TwiceDriven(upright, 0, displacement).scene);
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < both.displacement.size(); ++i) {
    largest = std::max(largest, std::fabs(both.displacement[i]));
    worst = std::max(worst, std::fabs(both.displacement[i] - x.displacement[i] - z.displacement[i]));
  }
  CHECK(largest > 0.9 * displacement);
  CHECK(worst < small * largest);

  // The block is symmetric: shear along x and stretch along z have no energy in common.
  double force = 0, work[2] = {0, 0}, worst_force = 0, worst_work = 0, imbalance = 0, most = 0;
  for (std::size_t s = 0; s < both.samples.size(); ++s) {
    const HistorySample &sample = both.samples[s], &of_x = x.samples[s], &of_z = z.samples[s];
    const auto& [push, pull] = std::tie(sample.reactions[0], sample.reactions[1]);
    CHECK(push.force[2] == 0);
    CHECK(pull.force[0] == 0);
    force = std::max({force, std::fabs(push.force[0]), std::fabs(pull.force[2])});
    worst_force = std::max({worst_force, std::fabs(push.force[0] - of_x.reactions[0].force[0]),
                            std::fabs(pull.force[2] - of_z.reactions[1].force[2])});
    work[0] = std::max(work[0], std::fabs(push.work));
    work[1] = std::max(work[1], std::fabs(pull.work));
    worst_work = std::max(
        {worst_work, std::fabs(push.work - of_x.reactions[0].work), std::fabs(pull.work - of_z.reactions[1].work)});
    CHECK_THAT(push.work + pull.work, WithinAbs(sample.energy.external_work, 1e-12 * (work[0] + work[1])));
    most = std::max(most, largest_energy(sample.energy));
    imbalance = std::max(imbalance, std::fabs(sample.energy.balance_error));
    // The set's history has both.
    for (int i = 0; i < 3; i += 2)
      CHECK_THAT(sample.sets[0].velocity[i], WithinAbs((i == 0 ? of_x : of_z).sets[0].velocity[i], small * velocity));
  }
  INFO("force off by " << worst_force << " of " << force << " N, work by " << worst_work << " of " << work[0] << " and "
                       << work[1] << " J; imbalance " << imbalance << " of " << most << " J");
  CHECK(work[0] > 0.01 * work[1]);
  CHECK(work[1] > 0.01 * work[0]);
  CHECK(worst_force < small * force);
  CHECK(worst_work < small * (work[0] + work[1]));
  CHECK(imbalance < 0.01 * most);
}

TEST_CASE("a block that one motion stretches and another squeezes across has the forces of plane stress") {
  scene::Scene scene = block_scene({0.02, 0.02, 0.04}, {2, 2, 4}, 6e-4);
  hold_lower_faces(scene, "block");
  scene.parts[0].mass_damping = 1e5;  // calms the block within the run
  add_ramp(scene, "first", 0, 2e-4);
  add_ramp(scene, "second", 1e-4, 2e-4);
  const double along = 1e-4, across = -5e-5;  // strains; the third direction is free
  scene.prescribed_motions = {motion("block.z_max", {0, 0, 0}, {0, 0, 0}), motion("block.x_max", {0, 0, 0}, {0, 0, 0})};
  scene::PrescribedMotion &stretch = scene.prescribed_motions[0], &squeeze = scene.prescribed_motions[1];
  squeeze.name = "squeezed";
  stretch.displacement = {0, 0, 0.04 * along};
  squeeze.displacement = {0.02 * across, 0, 0};
  stretch.displacement_curve = "first";
  squeeze.displacement_curve = "second";
  stretch.directions = {false, false, true};
  squeeze.directions = {true, false, false};
  scene.output.history_interval = 1e-4;
  const HistorySample last = result_of(scene).samples.back();
  const double modulus = 210e9 / (1 - 0.3 * 0.3), z = modulus * (along + 0.3 * across),
               x = modulus * (across + 0.3 * along);
  // The block has changed its faces by some strains' share.
  const double share = 4 * along;
  CHECK_THAT(last.reactions[0].force[2], WithinRel(4e-4 * z, share));
  CHECK_THAT(last.reactions[1].force[0], WithinRel(8e-4 * x, share));
  CHECK_THAT(last.energy.internal, WithinRel(0.5 * 16e-6 * (z * along + x * across), share));
  CHECK_THAT(last.reactions[0].work + last.reactions[1].work, WithinRel(last.energy.external_work, 1e-12));
}

TEST_CASE("two motions along axes of their own keep the balance of energy, and places to the last bit") {
  const auto axes = oblique_axes();
  const RunResult both = result_of(TwiceDriven(axes, 2.0, 1e-4).scene);
  double imbalance = 0, most = 0;
  for (const HistorySample& sample : both.samples) {
    most = std::max(most, largest_energy(sample.energy));
    imbalance = std::max(imbalance, std::fabs(sample.energy.balance_error));
    const Vec3 push{sample.reactions[0].force[0], sample.reactions[0].force[1], sample.reactions[0].force[2]};
    CHECK_THAT(dot(push, axes[2]), WithinAbs(0, 1e-12 * std::sqrt(dot(push, push))));
  }
  CHECK(imbalance < 0.01 * most);
}

TEST_CASE("two motions of one curve along two directions are one motion along both, to the last bit") {
  scene::Scene two = block_scene({0.04, 0.04, 0.08}, {4, 4, 8}, 8e-5);
  hold(two, "block.z_min", {true, true, true});
  two.curves.push_back(curve({{0, 0}, {2e-5, 1}, {4e-5, -0.5}, {8e-5, 0.5}}));
  two.output.history_interval = 2e-6;
  two.output.history_sets = {"block.z_max"};
  scene::Scene one = two;
  one.prescribed_motions.push_back(motion("block.z_max", {2, 0, 1}, {0, 50, 0}));
  one.prescribed_motions[0].curve = "pace";
  one.prescribed_motions[0].directions = {true, false, true};
  for (const bool along_x : {true, false}) {
    two.prescribed_motions.push_back(one.prescribed_motions[0]);
    two.prescribed_motions.back().directions = {along_x, false, !along_x};
    two.prescribed_motions.back().name = along_x ? "x" : "z";
  }
  const RunResult of_one = result_of(one), of_two = result_of(two);
  CHECK(of_one.displacement == of_two.displacement);
  REQUIRE(of_one.samples.size() == of_two.samples.size());
  for (std::size_t s = 0; s < of_one.samples.size(); ++s) {
    const HistorySample &a = of_one.samples[s], &b = of_two.samples[s];
    CHECK(a.sets[0].velocity == b.sets[0].velocity);
    CHECK(a.sets[0].acceleration == b.sets[0].acceleration);
    CHECK(b.reactions[0].force[0] == a.reactions[0].force[0]);
    CHECK(b.reactions[1].force[2] == a.reactions[0].force[2]);
    CHECK_THAT(b.reactions[0].work + b.reactions[1].work,
               WithinAbs(a.reactions[0].work, 1e-12 * largest_energy(a.energy)));
    CHECK_THAT(b.energy.kinetic, WithinAbs(a.energy.kinetic, 1e-12 * largest_energy(a.energy)));
  }
}

TEST_CASE("motions of one node are perpendicular, and methods that cannot prescribe one say so") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  scene.prescribed_motions.push_back(motion("block.z_min", {5, 0, 0}, {0, 0, 0}));
  const auto complaint = [&] { return complaint_of_building(scene); };
  CHECK(complaint().empty());
  SECTION("twice") {
    scene.prescribed_motions.push_back(motion("block.x_min", {5, 0, 0}, {0, 0, 0}));
    CHECK_THAT(complaint(), ContainsSubstring("the node of 'block.x_min' at") &&
                                ContainsSubstring("moved in the same directions by [prescribed_motion.driven]"));
    for (auto& one : scene.prescribed_motions) one.directions = {true, false, false};
    CHECK_THAT(complaint(), ContainsSubstring("moved in the same directions"));
    scene.prescribed_motions[1].directions = {false, true, true};
    CHECK(complaint().empty());
  }
  SECTION("single precision") {
    scene.solver.precision = scene::Precision::single_precision;
    CHECK_THAT(complaint(), ContainsSubstring("set precision to \"mixed\" or \"double\""));
  }
}
