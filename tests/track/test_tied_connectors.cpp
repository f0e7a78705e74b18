#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <set>

#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

// Fastenings whose areas lie on surfaces that a tie joins: on the slave's nodes, on the master's, or across both.
namespace {

const Vec3 stiffness{2e6, 3e6, 7e6};

scene::Scene joined(const std::string& to, double gap, bool tied) {
  TiedBlocks blocks;
  blocks.coarse = {3, 3, 2};
  blocks.fine = {7, 8, 5};
  blocks.gap = gap;
  scene::Scene scene = blocks.scene(1e-3);
  set_hourglass(scene.parts[1], scene::HourglassType::stiffness, 0.05);
  scene.ties[0].max_distance = 2 * gap + 1e-3;
  if (!tied) scene.ties.clear();
  scene::Connector& seat = add_spring(scene, "ground", to, stiffness);
  seat.spread = {3, 2};
  seat.area = scene::Box{{{0.01, 0.005, -1}, {0.055, 0.05, 1}}};
  return scene;
}

struct Resultant {
  Vec3 force{0, 0, 0}, moment{0, 0, 0};
};

/// Of what the scheme accelerates nodes with; slaves have nothing of their own.
Resultant of_all(const Model& model) {
  Resultant sum;
  std::set<int> slaves;
  for (const TiedPlace& tied : model.ties.places) slaves.insert(tied.slave);
  const auto mass = scheme_masses(model);
  const auto acceleration = node_field(model, model.ties, NodeField::acceleration, all_nodes(model)).values;
  const auto x = to_host(model.nodes.position);
  for (int n = 0; n < model.nodes.count; ++n) {
    if (slaves.count(n) != 0) continue;
    const Vec3 f = mass[n] * Vec3{acceleration[3 * n], acceleration[3 * n + 1], acceleration[3 * n + 2]};
    sum.force = sum.force + f;
    sum.moment = sum.moment + cross(Vec3{x(n, 0), x(n, 1), x(n, 2)}, f);
  }
  return sum;
}

/// Both blocks moved as one rigid body, so that nothing but the connector pulls.
Resultant reaction(const scene::Scene& scene) {
  Model model;
  build_model(scene, model);
  const auto axes = oblique_axes();
  const double angle = 0.3;
  set_position(model, [&](const Vec3& x, int) {
    const Vec3 along = dot(x, axes[0]) * axes[0], across = x - along;
    return Vec3{1e-3, -2e-3, 3e-3} + along + std::cos(angle) * across + std::sin(angle) * cross(axes[0], across);
  });
  compute_forces(model);
  return of_all(model);
}

}  // namespace

TEST_CASE("a connector on tied surfaces gives the bodies the same force and moment as without the tie") {
  for (double gap : {0.0, 1e-3})
    for (const char* to : {"fine.z_min", "coarse.z_max"}) {
      INFO(to << ", gap " << gap);
      const Resultant with = reaction(joined(to, gap, true)), without = reaction(joined(to, gap, false));
      CHECK(norm(without.force) > 1e3);
      CHECK(norm(without.moment) > 50);
      CHECK(norm(with.force - without.force) < 1e-9 * norm(without.force));
      CHECK(norm(with.moment - without.moment) < 1e-9 * norm(without.moment));
    }
}

TEST_CASE("tied blocks settle on a connector under the tie: it bears the load, and they are in balance") {
  for (const char* to : {"fine.z_min", "coarse.z_max"}) {
    scene::Scene scene = joined(to, 1e-3, true);
    const Vec3 applied{3e2, -2e2, -2e3};
    add_force(scene, "fine.z_max", applied);
    scene.settle.active = true;
    scene.settle.method = scene::SettleMethod::newton;
    scene.settle.tolerance = 1e-8;
    Model model;
    build_model(scene, model);
    const SettleReport report = settle_whole(model);
    INFO(to << ": " << report.steps << " evaluations, unbalance " << report.unbalance << "; " << report.adrift);
    REQUIRE(report.settled);
    compute_forces(model);
    Vec3 carried{};
    const auto force = to_host(model.connectors.arrays.force);
    for (int c = 0; c < model.connectors.arrays.count; ++c)
      carried = carried + Vec3{force(c, 0), force(c, 1), force(c, 2)};
    CHECK(norm(carried + applied) < 1e-6 * norm(applied));
    const Resultant left = of_all(model);
    CHECK(norm(left.force) < 1e-6 * norm(applied));
    CHECK(norm(left.moment) < 1e-7 * norm(applied));
  }
}

TEST_CASE("a tie and a connector on the same surfaces: the account of a run closes") {
  scene::Scene scene = joined("fine.z_min", 1e-3, true);
  scene.connectors[0].preload = {1e3, 2e3, 3e3};
  Model model;
  build_model(scene, model);
  Recorder recorder;
  REQUIRE(run(model, {&recorder}).completed);
  const EnergyAccount& last = recorder.samples.back().energy;
  CHECK(last.kinetic > 0.1);
  CHECK(std::fabs(last.balance_error) < 1e-3 * last.kinetic);
}
