#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/beam_scene.hpp"
#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

// Newton's method on ends, ties, beams and bolts, against dynamic relaxation.
namespace {

/// What a scene's rest looks like.
struct Rest {
  std::vector<double> displacement, rotation;  ///< m, quaternions
  SettleReport report;
  double largest() const {
    double most = 0;
    for (double u : displacement) most = std::max(most, std::fabs(u));
    return most;
  }
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

Rest settled(scene::Scene scene, scene::SettleMethod method, double tolerance, Model& model) {
  scene.settle.active = true;
  scene.settle.method = method;
  scene.settle.tolerance = tolerance;
  scene.settle.max_steps = 200000;
  build_model(scene, model);
  Rest rest;
  rest.report = settle_whole(model);
  INFO(rest.report.steps << " evaluations in " << rest.report.iterations << " steps, unbalance "
                         << rest.report.unbalance << "; " << rest.report.adrift);
  REQUIRE(rest.report.settled);
  rest.displacement = node_field(model, model.ties, NodeField::displacement, all_nodes(model)).values;
  if (!model.beams) return rest;
  const auto q = to_host(model.beams->arrays.rotation);
  for (int b = 0; b < model.beams->arrays.node_count; ++b)
    for (int k = 0; k < 4; ++k) rest.rotation.push_back(q(b, k));
  return rest;
}

/// Settles by both; the same place must come out, in fewer evaluations.
/// @param share of the largest displacement, and as an angle, by which they may differ
void check_both(const char* what, const scene::Scene& scene, Model& by_newton, double share) {
  const Rest newton = settled(scene, scene::SettleMethod::newton, 1e-8, by_newton);
  Model by_relaxation;
  const Rest relaxed = settled(scene, scene::SettleMethod::relaxation, 1e-7, by_relaxation);
  const double apart = largest_difference(newton.displacement, relaxed.displacement) / relaxed.largest();
  const double turned = largest_difference(newton.rotation, relaxed.rotation);
  WARN(what << ": " << newton.report.steps << " evaluations in " << newton.report.iterations << " steps, by relaxation "
            << relaxed.report.steps << "; displacements " << apart << " of the largest apart, rotations " << turned);
  CHECK(relaxed.largest() > 0);
  CHECK(apart < share);
  CHECK(turned < share);
  CHECK(newton.report.steps < relaxed.report.steps);
}

scene::Scene block_between_ends() {
  scene::Scene scene = block_scene({0.2, 0.05, 0.05}, {16, 4, 4}, 1e-3);
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  for (const char* name : {"block.x_min", "block.x_max"}) {
    scene::NonReflecting end;
    end.name = name;
    end.target = name;
    scene.non_reflecting.push_back(end);
  }
  add_force(scene, "block.z_max", {2e4, 5e3, -1e4});
  return scene;
}

}  // namespace

TEST_CASE("Newton's method holds non-reflecting ends as relaxation does, and they bear the load afterwards",
          "[static]") {
  Model model;
  check_both("ends", block_between_ends(), model, 1e-5);
  const auto support = to_host(model.ends.arrays.support);
  Vec3 sum{};
  for (int k = 0; k < model.ends.arrays.count; ++k) sum = sum + Vec3{support(k, 0), support(k, 1), support(k, 2)};
  const Vec3 applied{2e4, 5e3, -1e4};
  CHECK(norm(sum + applied) < 1e-6 * norm(applied));
  const std::vector<int> ends = model.ends.nodes;
  for (double u : node_field(model, model.ties, NodeField::displacement, ends).values) CHECK(u == 0);
}

TEST_CASE("Newton's method settles tied blocks, with a gap between them or none", "[static]") {
  for (double gap : {0.0, 2e-3}) {
    TiedBlocks blocks;
    blocks.gap = gap;
    blocks.coarse = {3, 3, 3};
    blocks.fine = {8, 7, 6};
    scene::Scene scene = blocks.scene(1e-4);
    scene.ties[0].max_distance = 3e-3;
    set_hourglass(scene.parts[1], scene::HourglassType::stiffness, 0.05);
    hold(scene, "coarse.z_min", {true, true, true});
    add_force(scene, "fine.z_max", {2e4, 5e3, -3e4});
    Model model;
    check_both(gap > 0 ? "tie over a gap" : "tie", scene, model, 1e-4);
    // Slaves are where the ties put them.
    const auto position = to_host(model.nodes.position);
    for (const TiedPlace& tied : model.ties.places) {
      const Vector3 x = tied.place(position);
      for (int i = 0; i < 3; ++i) CHECK_THAT(position(tied.slave, i), WithinAbs(x[i], 1e-15));
    }
  }
}

TEST_CASE("stress goes through a tie unchanged when Newton's method has settled it", "[static]") {
  const TiedBlocks blocks;
  scene::Scene scene = blocks.pulled();
  Model model;
  settled(scene, scene::SettleMethod::newton, 1e-8, model);
  const auto stress = element_stress(model, model.nodes, all_elements(model)).values;
  for (std::size_t k = 0; k < stress.size(); ++k) CHECK_THAT(stress[k], WithinAbs(k % 6 == 2 ? 1e6 : 0, 1e2));
}

TEST_CASE("Newton's method bends a beam to a quarter of a circle", "[static]") {
  const double length = 1.2, radius = 0.03, angle = M_PI / 2, bending = 210e9 * M_PI / 4 * std::pow(radius, 4);
  const auto axes = oblique_axes();
  scene::Scene scene = beam_scene(length * axes[0], radius, 16, 1e-3);
  clamp(scene, "root");
  add_torque(scene, "tip", bending * angle / length, axes[2]);
  Model model;
  const Rest rest = settled(scene, scene::SettleMethod::newton, 1e-9, model);
  WARN("quarter of a circle: " << rest.report.steps << " evaluations in " << rest.report.iterations << " steps");
  CHECK_THAT(dot(rotation(model, "tip"), axes[2]), WithinRel(angle, 1e-7));
  const Vec3 u = displacement(model, "tip");
  CHECK_THAT(length + dot(u, axes[0]), WithinRel(length / angle * std::sin(angle), 1e-3));
  CHECK_THAT(dot(u, axes[1]), WithinRel(length / angle * (1 - std::cos(angle)), 1e-3));
}

TEST_CASE("Newton's method bends a cantilever far by a force at its tip, as relaxation does", "[static]") {
  scene::Scene scene = beam_scene({1.2, 0, 0}, 0.01, 8, 1e-3);
  clamp(scene, "root");
  add_force(scene, "tip", {300, 200, -2000});
  Model model;
  check_both("cantilever", scene, model, 1e-5);
  CHECK(displacement(model, "tip")[2] < -0.3);
}

namespace {

/// The bolted cube whose lower face is held; it is pushed aside.
scene::Scene pushed_bolted_cube() {
  scene::Scene scene = bolted_cube(12500, 1e-4);
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  scene.gravity = {0, 0, -9.81e3};
  hold(scene, "block.z_min", {true, true, true});
  add_force(scene, "block.x_max", {2e3, 1e3, 0});
  return scene;
}

}  // namespace

TEST_CASE("Newton's method tightens a bolt, whose weight its ends bear", "[static]") {
  Model model;
  check_both("bolt", pushed_bolted_cube(), model, 1e-4);
  compute_forces(model);
  const BeamResultants shank = beam_resultants(*model.beams, model.nodes)[0];
  // Section forces of its four elements, from below: what lies between their middles hangs on those above.
  const double weight = 9.81e3 * 7800 * M_PI * 0.012 * 0.012 * 0.03;
  for (int e = 0; e < 4; ++e) CHECK_THAT(shank.force[3 * e], WithinAbs(12500 + (e - 2) * weight, 1e-2));
}

TEST_CASE("what hangs on beams that nothing holds is named", "[static]") {
  scene::Scene scene = pushed_bolted_cube();
  scene.constraints.clear();
  scene.settle.active = true;
  scene.settle.method = scene::SettleMethod::newton;
  scene.settle.tolerance = 1e-6;
  scene.settle.max_steps = 3000;
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  CHECK_FALSE(report.settled);
  CHECK(report.adrift.find("'block'") != std::string::npos);
}

TEST_CASE(
    "unless otherwise specified a scene settles by Newton's method, and by relaxation where a point mass would drift "
    "away",
    "[static]") {
  scene::Scene scene = block_between_ends();
  scene.settle.active = true;
  scene.settle.tolerance = 1e-6;
  scene.settle.max_steps = 100000;
  {
    Model model;
    build_model(scene, model);
    const SettleReport report = settle_whole(model);
    CHECK(report.settled);
    CHECK(report.iterations > 0);
    CHECK(report.remarks.empty());
  }
  add_point(scene, "body", 10, {0.1, 0.025, 0.5});
  scene.gravity = {0, 0, -9.81};
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  CHECK(report.settled);
  CHECK(report.iterations == 0);
  REQUIRE(report.remarks.size() == 1);
  CHECK(report.remarks[0].find("[points.body]") != std::string::npos);
  CHECK(report.remarks[0].find("holds point masses") != std::string::npos);
  for (double u : node_field(model, model.ties, NodeField::displacement, model.assembly.point_nodes).values)
    CHECK(u == 0);
}
