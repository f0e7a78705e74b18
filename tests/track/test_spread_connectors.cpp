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

constexpr double length = 0.3, width = 0.2;
const Vec3 stiffness{2e6, 3e6, 7e6};

/// A block over a longer and finer one, whose nodes don't match, joined over the area where they face each other.
scene::Scene two_blocks(std::array<int, 2> spread) {
  scene::Scene scene = block_scene({length, width, 0.1}, {3, 2, 2}, 1e-3);
  scene::MeshSource lower = scene.meshes[0];
  lower.name = "lower";
  lower.box.size = {2 * length, width, 0.1};
  lower.box.divisions = {7, 5, 2};
  scene.meshes.push_back(lower);
  scene.parts.push_back(scene.parts[0]);
  scene.parts[1].name = scene.parts[1].mesh = "lower";
  scene.parts[1].position = {-0.1, 0, -0.1};
  scene::Connector& bed = add_spring(scene, "lower.z_max", "block.z_min", stiffness);
  bed.name = "bed";
  bed.spread = spread;
  return scene;
}

struct Resultant {
  Vec3 force{0, 0, 0}, moment{0, 0, 0};
};

/// Of all forces on a part's nodes, about `centre`, from the nodes' accelerations.
Resultant on_part(const Model& model, int number, const Vec3& centre) {
  Resultant sum;
  const auto& part = model.assembly.parts[number];
  std::vector<int> nodes;
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n) nodes.push_back(n);
  const auto acceleration = node_field(model, model.ties, NodeField::acceleration, nodes).values;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 f = model.mass[nodes[k]] * Vec3{acceleration[3 * k], acceleration[3 * k + 1], acceleration[3 * k + 2]};
    sum.force = sum.force + f;
    sum.moment = sum.moment + cross(model.assembly.nodes[nodes[k]] - centre, f);
  }
  return sum;
}

/// The upper block shifted and turned a little as a rigid body about the area's middle.
Resultant reaction(const scene::Scene& scene, const Vec3& shift, const Vec3& turn, int part) {
  Model model;
  build_model(scene, model);
  const Vec3 centre{0.5 * length, 0.5 * width, 0};
  const auto& upper = model.assembly.parts[0];
  set_position(model, [&](const Vec3& x, int n) {
    return n < upper.first_node + upper.node_count ? x + shift + cross(turn, x - centre) : x;
  });
  compute_forces(model);
  return on_part(model, part, centre);
}

}  // namespace

TEST_CASE("a spread connector has its total stiffness to rounding, equal and opposite on both sides") {
  const scene::Scene scene = two_blocks({3, 2});
  const double shift = 1e-7;
  for (int i = 0; i < 3; ++i) {
    Vec3 by{0, 0, 0};
    by[i] = shift;
    const Resultant upper = reaction(scene, by, {0, 0, 0}, 0), lower = reaction(scene, by, {0, 0, 0}, 1);
    // Places of order 0.1 m are known to 1e-17 m, so a shift of 1e-7 m to 1e-10.
    for (int j = 0; j < 3; ++j) {
      CHECK_THAT(upper.force[j], WithinAbs(i == j ? -stiffness[i] * shift : 0, 1e-8));
      CHECK_THAT(upper.force[j] + lower.force[j], WithinAbs(0, 1e-8));
    }
    if (i == 2)
      for (double moment : upper.moment) CHECK_THAT(moment, WithinAbs(0, 1e-9));
  }
}

TEST_CASE("a spread connector resists rotations as a bed does, less what its cells can't") {
  for (const std::array<int, 2> spread : {std::array<int, 2>{1, 1}, {2, 3}, {4, 3}, {6, 5}}) {
    const scene::Scene scene = two_blocks(spread);
    const double angle = 1e-6;
    const auto bed = [](double k, double side, int cells) {
      return k * side * side / 12 * (1 - 1.0 / (cells * cells));
    };
    const double roll = bed(stiffness[2], width, spread[1]), pitch = bed(stiffness[2], length, spread[0]);
    // Sideways springs lie in the plane of the turn's centre; in a turn about z they all work.
    const double yaw = bed(stiffness[0], width, spread[1]) + bed(stiffness[1], length, spread[0]);
    INFO("cells " << spread[0] << " x " << spread[1]);
    CHECK_THAT(reaction(scene, {0, 0, 0}, {angle, 0, 0}, 0).moment[0], WithinAbs(-roll * angle, 1e-8));
    CHECK_THAT(reaction(scene, {0, 0, 0}, {0, angle, 0}, 0).moment[1], WithinAbs(-pitch * angle, 1e-8));
    CHECK_THAT(reaction(scene, {0, 0, 0}, {0, 0, angle}, 0).moment[2], WithinAbs(-yaw * angle, 1e-8));
  }
}

TEST_CASE("a connector's area bounds it, and ground may be one end") {
  scene::Scene scene = two_blocks({2, 2});
  scene.connectors[0].from = "ground";
  scene.connectors[0].area = {{{0.05, -1, -1}, {0.15, 1, 1}}};
  const double angle = 1e-7;
  // The cells' middles are at 0.075 and 0.125, so 0.075 and 0.025 from the turn's centre.
  const double pitch = 0.5 * stiffness[2] * (0.075 * 0.075 + 0.025 * 0.025);
  CHECK_THAT(reaction(scene, {0, 0, 0}, {0, angle, 0}, 0).moment[1], WithinAbs(-pitch * angle, 1e-9));
}

TEST_CASE("a block on a spread bed swings at its theory's frequency, stable at the step chosen") {
  scene::Scene scene = two_blocks({3, 2});
  scene.connectors[0].from = "ground";
  // Soft beside the block itself: it moves as a whole.
  scene.connectors[0].stiffness = {1e5, 1e5, 1e5};
  add_motion(scene, {"block"}, {0, 0, 0.01});
  const double mass = 7800 * length * width * 0.1, omega = std::sqrt(1e5 / mass);
  scene.time.end = 2.2 * 2 * M_PI / omega;
  scene.parts[0].hourglass_coefficient = scene.parts[1].hourglass_coefficient = 0.05;
  scene.materials[0].youngs_modulus = 2.1e8;
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  std::vector<double> place;
  march(model, model.step_count,
        [&] { place.push_back(mean(model, NodeField::displacement, model.assembly.node_sets.at("block.z_max"))[2]); });
  CHECK_THAT(angular_frequency(place, model.step_size), WithinRel(omega, 1e-3));
}

TEST_CASE("stiff spread connectors are stable at the step chosen") {
  scene::Scene scene = two_blocks({4, 4});
  scene.connectors[0].stiffness = {8e11, 8e11, 8e11};
  scene.connectors[0].damping = {1e5, 1e5, 1e5};
  Model model;
  build_model(scene, model);
  CHECK(model.stable_step.connector < model.stable_step.elements);
  set_velocity(model, [](const Vec3& x, int) {
    return 1e-3 * Vec3{std::sin(90 * x[0] + 1), std::sin(70 * x[1]), std::sin(110 * x[2] + 2)};
  });
  double fastest = 0;
  march(model, 1500, [&] {
    if (model.step % 100 == 0)
      for (double v : node_field(model, model.ties, NodeField::velocity, all_nodes(model)).values)
        fastest = std::isfinite(v) ? std::max(fastest, std::fabs(v)) : 1e300;
  });
  CHECK(fastest < 0.02);
}

TEST_CASE("ends that cannot be spread over are reported with what is missing") {
  const auto complaint = [](const scene::Scene& scene) {
    Model model;
    try {
      build_model(scene, model);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  scene::Scene nodes = two_blocks({2, 2});
  nodes.node_sets.push_back({});
  nodes.node_sets[0].name = "few";
  nodes.node_sets[0].part = "block";
  nodes.node_sets[0].box = {{{0, 0, 0}, {1, 1, 0}}};
  nodes.connectors[0].to = "block.few";
  CHECK_THAT(complaint(nodes), ContainsSubstring("[connectors.bed] to: 'block.few' is a set of nodes without faces"));
  scene::Scene apart = two_blocks({2, 2});
  apart.parts[1].position = {5, 0, -0.1};
  CHECK_THAT(complaint(apart),
             ContainsSubstring("[connectors.bed] spread: 'lower.z_max' and 'block.z_min' do not face each other"));
  scene::Scene outside = two_blocks({2, 2});
  outside.connectors[0].area = {{{5, 5, -1}, {6, 6, 1}}};
  CHECK_THAT(complaint(outside),
             ContainsSubstring("do not face each other along the third of the axes, or not within the area"));
  scene::Scene low = two_blocks({2, 2});
  low.connectors[0].area = {{{0, 0, -1}, {1, 1, -0.5}}};
  CHECK_THAT(complaint(low), ContainsSubstring("[connectors.bed] area: has no face of 'lower.z_max' in it"));
}
