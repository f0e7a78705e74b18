#include <catch2/catch_test_macros.hpp>
#include <map>

#include "tests/verify/beam_scene.hpp"
#include "tests/verify/graded_bar.hpp"
#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

// Subcycling beside what else a scene has: contact with friction, ties, prescribed motions, beams, settling, materials
// that yield.

namespace {

/// A block of small elements on one of large ones, which is held at its foot.
scene::Scene block_on_coarse_one(const Vec3& lower_size, const std::array<int, 3>& lower_divisions, double friction,
                                 scene::ContactAlgorithm algorithm = scene::ContactAlgorithm::penalty) {
  TwoBlocks blocks;
  blocks.algorithm = algorithm;
  blocks.lower_size = lower_size;
  blocks.lower_divisions = lower_divisions;
  blocks.upper_divisions = {16, 16, 4};
  blocks.friction = friction;
  scene::Scene scene = blocks.scene(3e-4);
  hold(scene, "lower.z_min", {true, true, true});
  scene.output.history_interval = 1e-6;
  return scene;
}

struct SlidingRun {
  std::vector<double> time;
  std::vector<Vec3> force;  ///< N, on the upper block
  double gain = 0, imbalance = 0;
  EnergyAccount last;

  /// Between two samples.
  Vec3 at(double t) const {
    std::size_t k = 1;
    while (k + 1 < time.size() && time[k] < t) ++k;
    const double s = (t - time[k - 1]) / (time[k] - time[k - 1]);
    return (1 - s) * force[k - 1] + s * force[k];
  }
};

/// The upper block slides at 20 m/s while it is pressed on, up to 20 kN.
SlidingRun slide(scene::ContactAlgorithm algorithm, bool subcycling) {
  scene::Scene scene = block_on_coarse_one({0.24, 0.24, 0.16}, {12, 12, 8}, 0.3, algorithm);
  scene.solver.subcycling = subcycling;
  add_ramp(scene, "press", 0, 1e-4);
  add_force(scene, "upper.z_max", {0, 0, -2e4}, "press");
  add_motion(scene, {"upper"}, {20, 0, 0});
  Model model;
  build_model(scene, model);
  Recorder recorder;
  run(model, {&recorder});
  SlidingRun result;
  result.gain = model.subcycling.gain();
  for (const HistorySample& sample : recorder.samples) {
    CHECK(model.subcycling.in_phase(sample.step));
    result.time.push_back(sample.time);
    result.force.push_back(sample.contacts[0].normal_force + sample.contacts[0].tangential_force);
    result.imbalance = std::max(result.imbalance, std::fabs(sample.energy.balance_error));
  }
  result.last = recorder.samples.back().energy;
  return result;
}

/// What a pulse of `share` of the yield strain has spent in plastic flow after its way through the graded bar, J; with
/// the energy that came with it, and what the account misses.
struct Flow {
  double plastic = 0, first = 0, imbalance = 0, gain = 0;
};

Flow flow(double share, bool subcycling) {
  const double yield_stress = 400e6, width = 0.08;
  GradedBar bar(20, 30, 1);
  scene::Material& material = bar.scene.materials[0];
  material.yield_stress = yield_stress;
  material.tangent_modulus = 21e9;
  // Held sideways, the stress deviator is that of 2 mu times the strain.
  const double strain = share * yield_stress / (2 * material.shear_modulus());
  const Pulse pulse{width, strain * width * std::exp(0.5), 5 * width, bar.wave_speed()};
  bar.scene.time.end = (bar.length() - 10 * width) / bar.wave_speed();
  bar.scene.output.history_interval = bar.scene.time.end / 50;
  hold(bar.scene, "block", {false, true, true});
  Model model;
  bar.build(model, subcycling);
  pulse.set(model);
  Recorder recorder;
  run(model, {&recorder});
  Flow result;
  result.gain = model.subcycling.gain();
  result.first = balance_total(recorder.samples.front().energy);
  for (const HistorySample& sample : recorder.samples)
    result.imbalance = std::max(result.imbalance, std::fabs(sample.energy.balance_error));
  result.plastic = recorder.samples.back().energy.plastic;
  return result;
}

}  // namespace

TEST_CASE("contact forces and friction of a sliding block are the same with subcycling below it") {
  for (const auto algorithm : both_algorithms) {
    const SlidingRun plain = slide(algorithm, false), subcycled = slide(algorithm, true);
    CHECK(subcycled.gain > (algorithm == scene::ContactAlgorithm::penalty ? 1.5 : 1.3));
    double largest = 0, difference = 0;
    for (std::size_t k = 0; k < subcycled.time.size(); ++k) {
      largest = std::max(largest, norm(subcycled.force[k]));
      difference = std::max(difference, norm(subcycled.force[k] - plain.at(subcycled.time[k])));
    }
    const double elastic = plain.last.internal + plain.last.contact;
    INFO(name_of(algorithm) << ": force " << largest << " N, difference " << difference << "; updates "
                            << subcycled.gain << " times fewer; friction " << plain.last.friction << " and "
                            << subcycled.last.friction << " J, elastic " << elastic << " J, imbalance "
                            << plain.imbalance << " and " << subcycled.imbalance << " J");
    CHECK(largest > 2e4);
    CHECK(difference < 5e-3 * largest);
    CHECK(std::fabs(subcycled.last.friction - plain.last.friction) < 1e-3 * plain.last.friction);
    CHECK(subcycled.imbalance < 1e-2 * elastic);
  }
}

namespace {

/// Whether all elements with a node of the list are of the finest level, and so these nodes.
bool of_finest_level(const Model& model, const std::vector<int>& nodes) {
  const auto level = to_host(model.subcycling.node_levels.level);
  std::vector<char> listed(model.nodes.count, 0);
  bool finest = !nodes.empty();
  for (int n : nodes) {
    listed[n] = 1;
    finest = finest && level(n) == 0;
  }
  for (const ElementGroup& group : model.elements)
    for (std::size_t p = 0; p < group.first_element.size(); ++p)
      for (int e = 0; e < group.element_count[p]; ++e)
        for (int n : model.assembly.elements[group.first_element[p] + e])
          finest = finest && (listed[n] == 0 || group.level == 0);
  return finest;
}

/// A slab of small elements tied to a long block of large ones.
scene::Scene fine_on_coarse(double end) {
  TiedBlocks blocks;
  blocks.size = {0.16, 0.16, 0.96};
  blocks.coarse = {4, 4, 24};
  blocks.fine = {12, 12, 3};
  scene::Scene scene = blocks.scene(end);
  scene.meshes[1].box.size[2] = 0.04;
  scene.output.history_interval = end / 50;
  return scene;
}

/// How a scene ends, and what its account misses on the way, over what it has been given.
struct Ending {
  std::map<Vec3, Vec3> displacement;  ///< by place, as levels number the nodes anew
  double imbalance = 0, gain = 0;
};

Ending ending_of(scene::Scene scene, bool subcycling) {
  scene.solver.subcycling = subcycling;
  Model model;
  build_model(scene, model);
  Recorder recorder;
  REQUIRE(run(model, {&recorder}).completed);
  Ending ending;
  ending.gain = model.subcycling.gain();
  double given = 0;
  for (const HistorySample& sample : recorder.samples) {
    given = std::max(given, largest_energy(sample.energy));
    ending.imbalance = std::max(ending.imbalance, std::fabs(sample.energy.balance_error));
  }
  ending.imbalance /= given;
  const auto u = node_field(model, model.ties, NodeField::displacement, all_nodes(model)).values;
  for (int n = 0; n < model.nodes.count; ++n)
    ending.displacement[model.assembly.nodes[n]] = {u[3 * n], u[3 * n + 1], u[3 * n + 2]};
  return ending;
}

/// Largest difference over the largest displacement.
double difference(const Ending& a, const Ending& b) {
  REQUIRE(a.displacement.size() == b.displacement.size());
  double largest = 0, most = 0;
  for (const auto& [place, displacement] : a.displacement) {
    largest = std::max(largest, norm(displacement));
    most = std::max(most, norm(displacement - b.displacement.at(place)));
  }
  return most / largest;
}

/// The coarse block's far end is driven, and stops.
scene::Scene driven_pair(double end) {
  scene::Scene scene = fine_on_coarse(end);
  scene::Curve curve;
  curve.name = "stops";
  curve.type = scene::CurveType::table;
  curve.points = {{0, 0}, {0.2 * end, 1}, {0.6 * end, 1}, {0.8 * end, 0}, {end, 0}};
  scene.curves.push_back(curve);
  scene::PrescribedMotion motion;
  motion.name = "driven";
  motion.target = "coarse.z_min";
  motion.velocity = {1, 0, 0.5};
  motion.curve = "stops";
  scene.prescribed_motions.push_back(motion);
  return scene;
}

/// Beams from the coarse block's far end to a hook, which is turned and pulled.
scene::Scene hooked_pair(double end) {
  scene::Scene scene = fine_on_coarse(end);
  scene.points.push_back(massless("hook", {0.08, 0.08, -0.1}));
  scene.beams.push_back(round_beam("hook", "coarse.z_min", 0.01, 2));
  add_ramp(scene, "pull", 0, 0.5 * end);
  add_torque(scene, "hook", 2000, {0, 1, 0}).curve = "pull";
  add_force(scene, "hook", {0, 0, -1e5}, "pull");
  return scene;
}

}  // namespace

TEST_CASE("what looks at forces on its nodes at each step, or moves them, has elements of the finest level") {
  SECTION("multipliers") {
    scene::Scene scene = block_on_coarse_one({0.24, 0.24, 0.16}, {12, 12, 8}, 0.3, scene::ContactAlgorithm::multiplier);
    scene.solver.subcycling = true;
    Model model;
    build_model(scene, model);
    REQUIRE(model.subcycling.levels > 1);
    CHECK(of_finest_level(model, model.contacts[0].slave_nodes));
    CHECK(of_finest_level(model, model.contacts[0].master_nodes));
  }
  SECTION("ties, prescribed motions and beams") {
    for (const bool driven : {true, false}) {
      scene::Scene scene = (driven ? driven_pair : hooked_pair)(1e-4);
      scene.solver.subcycling = true;
      Model model;
      build_model(scene, model);
      REQUIRE(model.subcycling.levels > 1);
      CHECK(of_finest_level(model, model.ties.masters));
      std::vector<int> slaves;
      for (const TiedPlace& tied : model.ties.places) slaves.push_back(tied.slave);
      CHECK(of_finest_level(model, slaves));
      CHECK(of_finest_level(model, model.assembly.node_sets.at("coarse.z_min")));
    }
  }
}

TEST_CASE("tied blocks that are driven, or pulled by beams, move as without subcycling, and keep their account") {
  for (const bool driven : {true, false}) {
    const scene::Scene scene = (driven ? driven_pair : hooked_pair)(1e-3);
    const Ending plain = ending_of(scene, false), subcycled = ending_of(scene, true);
    INFO((driven ? "driven" : "pulled") << ": updates " << subcycled.gain << " times fewer, difference "
                                        << difference(plain, subcycled) << ", imbalance " << plain.imbalance << " and "
                                        << subcycled.imbalance);
    CHECK(subcycled.gain > 1.1);
    CHECK(difference(plain, subcycled) < 1e-3);
    CHECK(subcycled.imbalance < 5e-3);
  }
}

TEST_CASE("tied blocks of which one is subcycled keep the energy of all their modes over 20 000 steps") {
  scene::Scene scene = fine_on_coarse(1);
  scene.solver.subcycling = true;
  scene.monitor.active = false;
  Model model;
  build_model(scene, model);
  scene.time.end = 20000 * model.step_size;
  scene.output.history_interval = scene.time.end / 40;
  build_model(scene, model = Model());
  REQUIRE(model.subcycling.levels > 1);
  shake(model);
  Recorder recorder;
  REQUIRE(run(model, {&recorder}).completed);
  const double first = balance_total(recorder.samples.front().energy);
  double early = 0, late = 0;
  for (std::size_t k = 0; k < recorder.samples.size(); ++k) {
    double& worst = k < recorder.samples.size() / 4 ? early : late;
    worst = std::max(worst, std::fabs(balance_total(recorder.samples[k].energy) / first - 1));
  }
  INFO("energy off by " << early << " in the first quarter, " << late << " later");
  CHECK(early < 0.05);
  CHECK(late < 1.5 * early);
}

TEST_CASE("a scene settles at the finest step, and rests when its run is subcycled") {
  scene::Scene scene = block_on_coarse_one({0.08, 0.08, 0.06}, {6, 6, 4}, 0);
  // Settling leans on stiffness control; a viscous one would let go of what that holds when the run begins.
  for (scene::Part& part : scene.parts) set_hourglass(part, scene::HourglassType::stiffness, 0.05);
  scene.gravity = {0, 0, -1e5};
  scene.settle.active = true;
  scene.settle.tolerance = 1e-4;
  scene.time.step_scale = 0.6;  // edge and corner nodes bear the whole contact spring on a part of the mass
  scene.solver.subcycling = true;
  Model model;
  build_model(scene, model);
  REQUIRE(model.subcycling.levels > 1);
  const double weight = 1e5 * mass_of(model, "upper");
  Recorder recorder;
  run(model, {&recorder});
  double worst = 0;
  for (const HistorySample& sample : recorder.samples)
    worst = std::max(worst, norm(sample.contacts[0].normal_force - Vec3{0, 0, weight}) / weight);
  INFO("contact force against weight: worst relative difference " << worst);
  CHECK(recorder.samples.size() > 100);
  CHECK(worst < 5e-3);
}

TEST_CASE("a pulse that yields loses as much in plastic flow with subcycling, and one that does not loses nothing") {
  // Of the same pulse on even meshes; those of 2.5 mm elements lose 1140 J at 0.1 and 1142 J at 0.9 of the stable step.
  const double exact = 1141;
  const Flow plain = flow(1.5, false), subcycled = flow(1.5, true), elastic = flow(0.9, true);
  INFO("plastic " << plain.plastic << " and " << subcycled.plastic << " J of " << plain.first << " J; imbalance "
                  << plain.imbalance << " and " << subcycled.imbalance << " J; below yield " << elastic.plastic
                  << " J");
  CHECK(subcycled.gain > 2);
  CHECK(std::fabs(subcycled.plastic - exact) < 1.05 * std::fabs(plain.plastic - exact));
  CHECK(std::fabs(plain.plastic - exact) < 0.15 * exact);
  CHECK(subcycled.imbalance < 1e-2 * subcycled.first);
  CHECK(elastic.plastic == 0);
}

TEST_CASE("the eigenvalue estimate gives the levels of a graded bar one element thick, and it stays stable") {
  GradedBar bar(6, 12, 1, 1);
  bar.scene.solver.step_estimate = scene::StepEstimate::eigenvalue;
  Model model;
  bar.scene.time.end = 20000 * 1e-3 / bar.wave_speed();
  bar.scene.output.history_interval = bar.scene.time.end / 100;
  bar.build(model, true);
  REQUIRE(model.subcycling.levels > 3);
  shake(model);
  Recorder recorder;
  run(model, {&recorder});
  const double first = balance_total(recorder.samples.front().energy);
  double worst = 0;
  for (const HistorySample& sample : recorder.samples)
    worst = std::max(worst, std::fabs(sample.energy.balance_error) / first);
  INFO("energy off by " << worst);
  CHECK(worst < 0.05);
}
