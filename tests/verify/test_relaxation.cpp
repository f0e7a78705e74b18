#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

/// A bar 0.5 m long hung by its upper end, in 20 layers.
scene::Scene hanging_bar(double tolerance) {
  scene::Scene scene = block_scene({0.05, 0.05, 0.5}, {2, 2, 20}, 1e-5);
  scene.settle.active = true;
  scene.settle.tolerance = tolerance;
  hold(scene, "block.z_max", {false, false, true});
  return scene;
}

/// Mean lengthening of the settled bar; by the mean motion of its lower end.
double lengthening(const scene::Scene& scene, Model& model) {
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  INFO("unbalance " << report.unbalance << " after " << report.steps << " steps");
  CHECK(report.settled);
  CHECK(report.unbalance < scene.settle.tolerance);
  for (double v : node_field(model, model.ties, NodeField::velocity, all_nodes(model)).values) CHECK(v == 0);
  return -mean(model, NodeField::displacement, model.assembly.node_sets.at("block.z_min"))[2];
}

}  // namespace

TEST_CASE("a bar settles to the length that its own weight gives it") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    scene::Scene scene = hanging_bar(1e-6);
    set_hourglass(scene.parts[0], hourglass, 0.1);
    scene.gravity = {0, 0, -9.81e3};
    Model model;
    const double found = lengthening(scene, model);
    // Nodal loads of linear elements give the exact rho g L^2 / 2 E at the nodes; strain of 1e-4 bends that by as much.
    CHECK_THAT(found, WithinRel(7800 * 9.81e3 * 0.25 / (2 * 210e9), 1e-3));
    // Stress in the upper layer is the weight below its middle.
    const auto stress = element_stress(model, model.nodes, {static_cast<int>(model.element_count()) - 1}).values;
    CHECK_THAT(stress[2], WithinRel(7800 * 9.81e3 * (0.5 - 0.0125), 1e-3));
  }
}

TEST_CASE("a bar under traction settles to its uniaxial stress, whatever its density") {
  std::vector<double> found;
  for (double density : {7800.0, 100.0}) {
    scene::Scene scene = hanging_bar(1e-7);
    scene.materials[0].density = density;
    add_traction(scene, "block.z_min", {0, 0, -21e6});
    Model model;
    found.push_back(lengthening(scene, model));
    CHECK_THAT(found.back(), WithinRel(0.5 * 21e6 / 210e9, 1e-3));
    const auto stress = element_stress(model, model.nodes, all_elements(model)).values;
    for (std::size_t k = 0; k < stress.size(); ++k) {
      if (k % 6 == 2)
        CHECK_THAT(stress[k], WithinRel(21e6, 1e-3));
      else
        CHECK(std::fabs(stress[k]) < 1e-3 * 21e6);
    }
  }
  CHECK_THAT(found[1], WithinRel(found[0], 1e-5));
}

TEST_CASE("a body that will rotate settles under its centrifugal field") {
  // A disc-like block about z: the mean in-plane stress of a body that spins is its moment of inertia over its volume.
  scene::Scene scene = block_scene({0.2, 0.2, 0.02}, {10, 10, 2}, 1e-5);
  scene.parts[0].position = {5, 3, 0};
  scene.settle.active = true;
  scene.settle.tolerance = 1e-5;
  add_motion(scene, {"block"}, {0, 0, 0}, {0, 0, 300});
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  INFO("unbalance " << report.unbalance << " after " << report.steps << " steps");
  CHECK(report.settled);
  const auto stress = element_stress(model, model.nodes, all_elements(model)).values;
  double mean_xx = 0, mean_yy = 0, second_moment = 0;
  for (long e = 0; e < model.element_count(); ++e) {
    mean_xx += stress[6 * e] / model.element_count();
    mean_yy += stress[6 * e + 1] / model.element_count();
  }
  // Integral of stress_xx over the volume = integral of rho omega^2 (x - c)^2 (virial theorem), with the lumped masses.
  for (int n = 0; n < model.nodes.count; ++n)
    second_moment += model.mass[n] * std::pow(model.assembly.nodes[n][0] - 5.1, 2);
  const double expected = 300.0 * 300.0 * second_moment / (0.2 * 0.2 * 0.02);
  CHECK_THAT(mean_xx, WithinRel(expected, 1e-3));
  CHECK_THAT(mean_yy, WithinRel(expected, 1e-3));
}
