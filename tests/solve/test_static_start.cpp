#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <map>

#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

scene::Scene settling(scene::Scene scene, double tolerance) {
  scene.settle.active = true;
  scene.settle.method = scene::SettleMethod::newton;
  scene.settle.tolerance = tolerance;
  return scene;
}

void check_settled(const Model& model, const SettleReport& report, int most_steps) {
  INFO(report.steps << " evaluations in " << report.iterations << " steps, unbalance " << report.unbalance << "; "
                    << report.adrift);
  CHECK(report.settled);
  CHECK(report.unbalance < model.scene.settle.tolerance);
  CHECK(report.steps < most_steps);
  WARN(report.steps << " evaluations in " << report.iterations << " steps, unbalance " << report.unbalance << "; "
                    << report.wall_seconds << " s");
}

}  // namespace

TEST_CASE("a block under pressure comes to its exact state by Newton's method", "[static]") {
  scene::Scene scene = settling(block_scene({0.05, 0.05, 0.5}, {4, 4, 40}, 1e-5), 1e-9);
  hold(scene, "block.z_min", {false, false, true});
  add_pressure(scene, "block.z_max", 210e6);
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  check_settled(model, report, 400);
  const auto stress = element_stress(model, model.nodes, all_elements(model)).values;
  for (std::size_t k = 0; k < stress.size(); ++k) CHECK_THAT(stress[k], WithinAbs(k % 6 == 2 ? -210e6 : 0.0, 10));
}

TEST_CASE("Newton's method lets one block rest on another with its weight", "[static]") {
  for (auto algorithm : both_algorithms)
    for (double friction : {0.0, 0.3}) {
      TwoBlocks blocks;
      blocks.algorithm = algorithm;
      blocks.friction = friction;
      blocks.upper_divisions = {5, 7, 2};
      scene::Scene scene = settling(blocks.scene(1e-3), 1e-6);
      scene.gravity = {0, 0, -1e5};
      scene.time.step_scale = 0.6;
      for (scene::Part& part : scene.parts) part.hourglass = scene::HourglassType::stiffness;
      hold(scene, "lower.z_min", {true, true, true});
      Model model;
      build_model(scene, model);
      INFO(name_of(algorithm) << ", friction " << friction);
      check_settled(model, settle_whole(model), 2000);
      const double weight = 1e5 * mass_of(model, "upper");
      double worst = 0;
      march(model, 200, [&] {
        const ContactTotals totals = contact_totals(model, model.contacts, 0);
        worst = std::max(worst, norm(totals.normal_force - weight * Vec3{0, 0, 1}) / weight);
      });
      INFO("worst " << worst);
      CHECK(worst < 1e-3);
      WARN("worst " << worst);
    }
}

namespace {

/// A rail-like bar on springs to the ground, one for every `seat_every` elements along it, loaded in its middle.
struct BarOnSprings {
  static constexpr int along = 240, seat_every = 4;
  double length = 6, height = 0.05, width = 0.05, foundation = 7e6, force = 1e4;  // m, m, m, N/m2, N

  Assembly build(scene::Scene& scene) const {
    scene = settling(block_scene({length, width, height}, {along, 2, 8}, 1e-5), 1e-6);
    set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
    hold(scene, "block.y_min", {false, true, false});
    hold(scene, "block.x_min", {true, false, false});
    Assembly assembly = assemble(scene);
    const double pitch = length / along;
    const auto row = [&](const std::string& name, double x, double z) {
      auto& nodes = assembly.node_sets[name];
      for (std::size_t n = 0; n < assembly.nodes.size(); ++n)
        if (std::fabs(assembly.nodes[n][0] - x) < 0.1 * pitch && std::fabs(assembly.nodes[n][2] - z) < 1e-6)
          nodes.push_back(static_cast<int>(n));
    };
    for (int k = seat_every / 2; k < along; k += seat_every) {
      const std::string seat = "seat" + std::to_string(k);
      add_spring(scene, "ground", "block." + seat, {0, 0, foundation * seat_every * pitch});
      row("block." + seat, k * pitch, 0);
    }
    row("block.middle", 0.5 * length, height);
    add_force(scene, "block.middle", {0, 0, -force});
    return assembly;
  }
};

}  // namespace

TEST_CASE("a bar on an elastic foundation bends as theory says, in some hundreds of evaluations", "[static]") {
  const BarOnSprings bar;
  scene::Scene scene;
  const Assembly assembly = bar.build(scene);
  Model model;
  build_model(scene, assembly, model);
  check_settled(model, settle_whole(model), 600);
  const double bending = 210e9 * bar.width * std::pow(bar.height, 3) / 12;
  const double beta = std::pow(bar.foundation / (4 * bending), 0.25);
  const Vec3 middle = mean(model, NodeField::displacement, model.assembly.node_sets.at("block.middle"));
  // Of a beam without end; ends are six wave lengths / 2 pi away. Shear adds a quarter per cent, one-point elements
  // take a little off EI.
  CHECK_THAT(-middle[2], WithinRel(bar.force * beta / (2 * bar.foundation), 0.01));
  // What the springs carry is what is put on.
  double carried = 0;
  const auto force = to_host(model.connectors.arrays.force);
  compute_forces(model);
  Kokkos::deep_copy(force, model.connectors.arrays.force);
  for (int c = 0; c < model.connectors.arrays.count; ++c) carried += force(c, 2);
  CHECK_THAT(carried, WithinRel(bar.force, 1e-6));
}

TEST_CASE("a sprung mass sinks until its spring carries it; one that nothing holds is named", "[static]") {
  scene::Scene scene = settling(block_scene({0.1, 0.1, 0.1}, {4, 4, 4}, 1e-5), 1e-8);
  scene.gravity = {0, 0, -10};
  hold(scene, "block.z_min", {true, true, true});
  add_point(scene, "body", 1000, {0.05, 0.05, 0.5});
  add_spring(scene, "block.z_max", "body", {0, 0, 1e6});
  {
    Model model;
    build_model(scene, model);
    check_settled(model, settle_whole(model), 200);
    const Vec3 body_moved = mean(model, NodeField::displacement, model.assembly.point_nodes);
    const Vec3 top_moved = mean(model, NodeField::displacement, model.assembly.node_sets.at("block.z_max"));
    CHECK_THAT(top_moved[2] - body_moved[2], WithinRel(0.01, 1e-6));
  }
  scene.connectors[0].stiffness = {1e6, 1e6, 0};
  Model model;
  build_model(scene, model);
  CHECK_THROWS_WITH(settle_whole(model), Catch::Matchers::ContainsSubstring("[points.body]") &&
                                             Catch::Matchers::ContainsSubstring("1e+04 N act on it along"));
}

TEST_CASE("a load that springs take up on the same nodes leaves nothing applied, and the block settles", "[static]") {
  for (const auto method : {scene::SettleMethod::newton, scene::SettleMethod::relaxation}) {
    scene::Scene scene = settling(block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-6), 1e-3);
    scene.settle.method = method;
    add_spring(scene, "ground", "block", {1e6, 2e6, 3e6});
    add_force(scene, "block", {1000, 500, 200});
    Model model;
    build_model(scene, model);
    const SettleReport report = settle_whole(model);
    INFO(report.steps << " evaluations, unbalance " << report.unbalance << "; " << report.adrift);
    CHECK(report.settled);
    const Vec3 moved = mean(model, NodeField::displacement, all_nodes(model)), expected{1e-3, 2.5e-4, 200 / 3e6};
    for (int i = 0; i < 3; ++i) CHECK_THAT(moved[i], WithinRel(expected[i], 1e-5));
  }
}

TEST_CASE("a scene of whose loads none has begun is settled as it lies", "[static]") {
  for (const auto method : {scene::SettleMethod::newton, scene::SettleMethod::relaxation}) {
    // Away from the origin, where places are rounded.
    scene::Scene scene = settling(block_scene({0.1, 0.1, 0.1}, {3, 3, 3}, 1e-6), 1e-3);
    scene.settle.method = method;
    scene.parts[0].position = {0.37, 1.23, 0.41};
    add_spring(scene, "ground", "block.z_min", {1e6, 2e6, 3e6});
    Model model;
    build_model(scene, model);
    const SettleReport report = settle_whole(model);
    INFO(report.steps << " evaluations, unbalance " << report.unbalance);
    CHECK(report.settled);
    CHECK(report.steps <= 50);
  }
}

TEST_CASE("a block that its load crushes is refused, for no state of finite forces is left to run from", "[static]") {
  scene::Scene scene = settling(block_scene({0.05, 0.05, 0.05}, {3, 3, 3}, 1e-5), 1e-3);
  scene.settle.method = scene::SettleMethod::relaxation;
  scene.materials[0].yield_stress = 1e8;
  hold(scene, "block.z_min", {true, true, true});
  add_pressure(scene, "block.z_max", 1e9);
  Model model;
  build_model(scene, model);
  REQUIRE_THROWS_WITH(settle_whole(model), Catch::Matchers::ContainsSubstring("[settle]: forces are no longer finite"));
}

TEST_CASE("a block that hangs on nothing does not settle, and is named", "[static]") {
  TwoBlocks blocks;
  scene::Scene scene = settling(blocks.scene(1e-3), 1e-6);
  scene.settle.max_steps = 300;
  scene.gravity = {0, 0, 1e5};  // away from what would hold it
  hold(scene, "lower.z_min", {true, true, true});
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  CHECK_FALSE(report.settled);
  CHECK_THAT(report.adrift, Catch::Matchers::ContainsSubstring("part 'upper'"));
}

namespace {

/// Largest difference of the contact force from the weight, over the weight, in a run without motion.
double worst_force(scene::Scene scene, bool settled, double end) {
  scene.settle.active = settled;
  scene.time.end = end;
  Model model;
  build_model(scene, model);
  if (settled) {
    const SettleReport report = settle_whole(model);
    INFO("unbalance " << report.unbalance);
    REQUIRE(report.settled);
  }
  const double weight = norm(scene.gravity) * mass_of(model, "upper");
  double worst = 0;
  march(model, model.step_count, [&] {
    worst = std::max(worst, std::fabs(norm(contact_totals(model, model.contacts, 0).normal_force) - weight) / weight);
  });
  return worst;
}

}  // namespace

TEST_CASE(
    "explicit run from the static start, no motion, 5 ms: the contact force stays, from the unsettled start it doesn't",
    "[static][long]") {
  for (auto algorithm : both_algorithms) {
    TwoBlocks blocks;
    blocks.algorithm = algorithm;
    blocks.friction = 0.3;
    blocks.upper_divisions = {5, 7, 2};
    scene::Scene scene = settling(blocks.scene(5e-3), 1e-5);
    scene.gravity = {0, 0, -1e5};
    scene.time.step_scale = 0.6;
    for (scene::Part& part : scene.parts) part.hourglass = scene::HourglassType::stiffness;
    hold(scene, "lower.z_min", {true, true, true});
    const double settled = worst_force(scene, true, 5e-3), unsettled = worst_force(scene, false, 5e-3);
    WARN(name_of(algorithm) << ": contact force off its static value by at most " << 100 * settled
                            << " %, from the unsettled start " << 100 * unsettled << " %");
    CHECK(settled < 0.005);
    CHECK(unsettled > 0.5);
  }
}

TEST_CASE("a long bar on springs: Newton's method against relaxation", "[static][long]") {
  const BarOnSprings bar;
  scene::Scene scene;
  const Assembly assembly = bar.build(scene);
  scene.settle.tolerance = 1e-3;
  std::map<scene::SettleMethod, SettleReport> report;
  for (auto method : {scene::SettleMethod::newton, scene::SettleMethod::relaxation}) {
    scene.settle.method = method;
    Model model;
    build_model(scene, assembly, model);
    report[method] = settle_whole(model);
    const SettleReport& of = report[method];
    const Vec3 middle = mean(model, NodeField::displacement, model.assembly.node_sets.at("block.middle"));
    WARN((method == scene::SettleMethod::newton ? "newton" : "relaxation")
         << ": " << (of.settled ? "settled" : "NOT settled") << " after " << of.steps << " evaluations, "
         << of.wall_seconds << " s, unbalance " << of.unbalance << ", middle " << 1e3 * middle[2] << " mm");
  }
  CHECK(report[scene::SettleMethod::newton].settled);
  CHECK(10 * report[scene::SettleMethod::newton].steps < report[scene::SettleMethod::relaxation].steps);
}
