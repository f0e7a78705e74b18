#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const double slope = M_PI / 6;
/// Down the slope, across, normal to it.
const std::array<Vec3, 3> slope_axes{
    {{std::cos(slope), 0, -std::sin(slope)}, {0, 1, 0}, {std::sin(slope), 0, std::cos(slope)}}};

}  // namespace

TEST_CASE("a block whose foot is held normal to a slope of 30 degrees slides with g sin 30") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 5e-3);
  scene.gravity = {0, 0, -9.81};
  hold(scene, "block", {false, true, true});
  scene.constraints[0].axes = slope_axes;
  Model model;
  build_model(scene, model);
  const auto nodes = all_nodes(model);
  double normal = 0;
  march(model, model.step_count, [&] {
    const auto u = node_field(model, model.ties, NodeField::displacement, nodes).values;
    for (int n : nodes)
      normal = std::max(normal, std::fabs(dot(slope_axes[2], Vec3{u[3 * n], u[3 * n + 1], u[3 * n + 2]})));
  });
  const double t = model.time;
  CHECK_THAT(dot(slope_axes[0], mean(model, NodeField::acceleration, nodes)), WithinRel(9.81 * 0.5, 1e-10));
  CHECK_THAT(dot(slope_axes[0], mean(model, NodeField::displacement, nodes)), WithinRel(0.25 * 9.81 * t * t, 1e-9));
  // A displacement of 6e-5 m, rounded at each of its steps.
  CHECK(normal < 1e-15);
}

TEST_CASE("constraints on one node combine: what is left is the direction that none of them holds") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-3);
  scene.gravity = {1, 2, -9.81};
  scene.materials[0].youngs_modulus = 1;  // or the rounding of the stress would be seen
  // Normals that are not at right angles; a third, on the top alone, leaves those nodes nothing.
  hold(scene, "block", {false, false, true});
  scene.constraints[0].axes = slope_axes;
  hold(scene, "block", {true, false, false});
  scene.constraints[1].axes = oblique_axes();
  hold(scene, "block.z_max", {true, true, true});
  Model model;
  build_model(scene, model);
  compute_forces(model);
  Vec3 left = cross(slope_axes[2], oblique_axes()[0]);
  left = (1 / norm(left)) * left;
  const Vec3 expected = dot(left, scene.gravity) * left;
  const auto& top = model.assembly.node_sets.at("block.z_max");
  const auto a = node_field(model, model.ties, NodeField::acceleration, all_nodes(model)).values;
  for (int n : all_nodes(model)) {
    const bool held = std::find(top.begin(), top.end(), n) != top.end();
    for (int i = 0; i < 3; ++i) {
      if (held)
        CHECK(a[3 * n + i] == 0);
      else
        CHECK_THAT(a[3 * n + i], WithinAbs(expected[i], 1e-12));
    }
  }
}

TEST_CASE("a node held in three directions, given one by one, never moves by a bit") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-4);
  scene.gravity = {1, 2, -9.81};
  for (int i = 0; i < 3; ++i) {
    hold(scene, "block.z_min", {i == 0, i == 1, i == 2});
    scene.constraints.back().axes = i == 0 ? slope_axes : oblique_axes();
  }
  Model model;
  build_model(scene, model);
  march(model, model.step_count, [] {});
  for (double u :
       node_field(model, model.ties, NodeField::displacement, model.assembly.node_sets.at("block.z_min")).values)
    CHECK(u == 0);
  CHECK(norm(mean(model, NodeField::displacement, model.assembly.node_sets.at("block.z_max"))) > 1e-9);
}

TEST_CASE("a constrained direction keeps the velocity that it began with") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-3);
  scene.gravity = {0, 0, -9.81};
  hold(scene, "block", {false, false, true});
  scene.constraints[0].axes = slope_axes;
  add_motion(scene, {"block"}, 3.0 * slope_axes[2]);
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  march(model, model.step_count, [] {});
  const auto v = node_field(model, model.ties, NodeField::velocity, all_nodes(model)).values;
  for (int n : all_nodes(model))
    CHECK_THAT(dot(slope_axes[2], Vec3{v[3 * n], v[3 * n + 1], v[3 * n + 2]}), WithinRel(3.0, 1e-13));
}
