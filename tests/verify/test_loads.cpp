#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A block turned as a whole into axes askew to the global ones, with warped insides.
Assembly tilted_block(const scene::Scene& scene) {
  Assembly assembly = assemble(scene);
  for (Vec3& x : assembly.nodes) x = turned(oblique_axes(), x);
  return assembly;
}

struct NodalForces {
  Vec3 sum{}, moment{};  ///< moment about the centre of mass
  double largest = 0;
};

/// Mass times acceleration of each node: with no deformation yet, the load's own forces.
NodalForces forces_on(const Model& model) {
  NodalForces result;
  const auto nodes = all_nodes(model);
  const auto a = node_field(model, model.ties, NodeField::acceleration, nodes).values,
             x = node_field(model, model.ties, NodeField::position, nodes).values;
  const Vec3 centre = mean(model, NodeField::position, nodes);
  for (int n : nodes) {
    const Vec3 f = model.mass[n] * Vec3{a[3 * n], a[3 * n + 1], a[3 * n + 2]};
    result.sum = result.sum + f;
    result.moment = result.moment + cross(Vec3{x[3 * n], x[3 * n + 1], x[3 * n + 2]} - centre, f);
    result.largest = std::max(result.largest, norm(f));
  }
  return result;
}

void check_vector(const Vec3& found, const Vec3& wanted, double tolerance) {
  for (int i = 0; i < 3; ++i) CHECK_THAT(found[i], WithinAbs(wanted[i], tolerance * norm(wanted)));
}

}  // namespace

TEST_CASE("a nodal force's total is shared over its set by mass") {
  scene::Scene scene = block_scene({0.3, 0.2, 0.1}, {3, 2, 2}, 1e-4);
  scene.materials[0].youngs_modulus = 1;  // or the rounding of the stress would be seen
  add_force(scene, "block.x_max", {100, -200, 300});
  Model model;
  build_model(scene, model);
  compute_forces(model);
  check_vector(forces_on(model).sum, scene.loads[0].force, 1e-12);
  const double set_mass = [&] {
    double sum = 0;
    for (int n : model.assembly.node_sets.at("block.x_max")) sum += model.mass[n];
    return sum;
  }();
  const auto a =
      node_field(model, model.ties, NodeField::acceleration, model.assembly.node_sets.at("block.x_max")).values;
  for (std::size_t k = 0; k < a.size(); ++k) CHECK_THAT(a[k], WithinRel(scene.loads[0].force[k % 3] / set_mass, 1e-9));
}

TEST_CASE("the centre of mass moves by F/m, whatever the body's deformation") {
  scene::Scene scene = block_scene({0.3, 0.2, 0.1}, {3, 2, 2}, 2e-3);
  add_force(scene, "block.x_max", {1e4, -2e4, 3e4});
  Model model;
  build_model(scene, model);
  const auto nodes = all_nodes(model);
  march(model, model.step_count, [] {});
  const Vec3 u = mean(model, NodeField::displacement, nodes), v = mean(model, NodeField::velocity, nodes);
  const double t = model.time, mass = total_mass(model);
  check_vector(v, (t / mass) * scene.loads[0].force, 1e-9);
  check_vector(u, (0.5 * t * t / mass) * scene.loads[0].force, 1e-9);
  CHECK(largest_stress(model) > 1e5);
}

TEST_CASE("traction and pressure push with their area times stress on a tilted box") {
  const auto axes = oblique_axes();
  const double area = 0.2 * 0.1;
  for (auto type : {scene::LoadType::traction, scene::LoadType::pressure}) {
    scene::Scene scene = block_scene({0.3, 0.2, 0.1}, {3, 4, 2}, 1e-4);
    add_load(scene, type, "block.x_max");
    scene.loads[0].traction = {1e5, -3e5, 2e5};
    scene.loads[0].pressure = 4e5;
    Model model;
    build_model(scene, tilted_block(scene), model);
    compute_forces(model);
    const Vec3 wanted = type == scene::LoadType::traction ? area * scene.loads[0].traction : (-4e5 * area) * axes[0];
    check_vector(forces_on(model).sum, wanted, 1e-9);
  }
}

TEST_CASE("a pressure all round a warped body has neither resultant nor moment") {
  scene::Scene scene = block_scene({0.3, 0.2, 0.1}, {3, 3, 3}, 1e-4);
  for (const char* side : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"})
    add_pressure(scene, std::string("block.") + side, 1e6);
  Assembly assembly = tilted_block(scene);
  warp(assembly, 0.03, 0.2, 3);
  Model model;
  build_model(scene, assembly, model);
  compute_forces(model);
  const NodalForces found = forces_on(model);
  CHECK(norm(found.sum) < 1e-9 * found.largest);
}

TEST_CASE("a pressure turns with its surface") {
  scene::Scene scene = block_scene({0.3, 0.2, 0.1}, {3, 2, 2}, 1e-4);
  add_pressure(scene, "block.z_max", 1e6);
  Model model;
  build_model(scene, model);
  set_position(model, [](const Vec3& x, int) { return turned(oblique_axes(), x); });
  compute_forces(model);
  check_vector(forces_on(model).sum, (-1e6 * 0.3 * 0.2) * oblique_axes()[2], 1e-9);
}

TEST_CASE("a torque changes the angular momentum by M t about its axis and has no resultant") {
  const Vec3 axis = oblique_axes()[1];
  scene::Scene scene = block_scene({0.3, 0.2, 0.1}, {3, 2, 2}, 1e-3);
  add_torque(scene, "block", 2e3, 5.0 * axis);  // any length
  Model model;
  build_model(scene, model);
  // The body flies and has gone far: the axis goes with it.
  set_velocity(model, [](const Vec3&, int) { return Vec3{30, -20, 50}; });
  const auto nodes = all_nodes(model);
  const Vec3 before = mean(model, NodeField::velocity, nodes);
  double worst_force = 0, worst_moment = 0;
  march(model, model.step_count, [&] {
    const NodalForces found = forces_on(model);
    worst_force = std::max(worst_force, norm(found.sum) / found.largest);
    worst_moment = std::max(worst_moment, std::fabs(dot(axis, found.moment) / 2e3 - 1));
  });
  INFO("resultant / largest nodal force " << worst_force << ", moment error " << worst_moment);
  CHECK(worst_force < 1e-9);
  CHECK(worst_moment < 1e-9);
  const Vec3 after = mean(model, NodeField::velocity, nodes);
  for (int i = 0; i < 3; ++i) CHECK_THAT(after[i], WithinRel(before[i], 1e-12));

  // Angular momentum about the axis through the centre of mass.
  const auto x = node_field(model, model.ties, NodeField::position, nodes).values,
             v = node_field(model, model.ties, NodeField::velocity, nodes).values;
  const Vec3 centre = mean(model, NodeField::position, nodes);
  double momentum = 0;
  for (int n : nodes)
    momentum += model.mass[n] * dot(axis, cross(Vec3{x[3 * n], x[3 * n + 1], x[3 * n + 2]} - centre,
                                                Vec3{v[3 * n], v[3 * n + 1], v[3 * n + 2]} - after));
  CHECK_THAT(momentum, WithinRel(2e3 * model.time, 1e-6));
}

TEST_CASE("the work of every kind of load becomes energy of the body") {
  for (auto type :
       {scene::LoadType::nodal_force, scene::LoadType::traction, scene::LoadType::pressure, scene::LoadType::torque}) {
    const bool on_nodes = type == scene::LoadType::nodal_force || type == scene::LoadType::torque;
    scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {3, 3, 3}, 2e-3);
    scene.parts[0].hourglass = scene::HourglassType::stiffness;
    add_ramp(scene, "on", 0, 1e-3);
    add_load(scene, type, on_nodes ? "block" : "block.x_min", "on");
    scene.loads[0].force = {3e4, 1e4, 0};
    scene.loads[0].traction = {3e6, 1e6, 0};
    scene.loads[0].pressure = 3e6;
    scene.loads[0].moment = 1e3;
    Model model;
    build_model(scene, model);
    march(model, model.step_count, [] {});
    const EnergyAccount energy = account_energies(model, model.step_size);
    INFO("load type " << static_cast<int>(type) << ": work " << energy.external_work << ", kinetic " << energy.kinetic
                      << ", imbalance " << balance_total(energy));
    CHECK(energy.external_work > 1);
    CHECK(energy.kinetic > 0.9 * energy.external_work);
    CHECK(std::fabs(balance_total(energy)) < 1e-4 * energy.external_work);
    // Independently of the account's own sum: the ramp's impulse on the mass.
    if (type == scene::LoadType::nodal_force) {
      const double impulse = norm(scene.loads[0].force) * (model.time - 0.5e-3);
      CHECK_THAT(energy.external_work, WithinRel(impulse * impulse / (2 * total_mass(model)), 1e-4));
    }
  }
}
