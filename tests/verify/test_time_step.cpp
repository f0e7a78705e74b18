#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

/// Keeps only the facets of a surface whose nodes all lie nearer to the z axis than `reach`, in x and in y.
void keep_middle(Assembly& assembly, const std::string& surface, double reach) {
  std::vector<Face> kept;
  for (const Face& face : assembly.surfaces.at(surface)) {
    bool inside = true;
    for (int n : assembly.face_nodes(face))
      inside = inside && std::fabs(assembly.nodes[n][0]) < reach && std::fabs(assembly.nodes[n][1]) < reach;
    if (inside) kept.push_back(face);
  }
  assembly.surfaces[surface] = kept;
}

/// Random velocities of up to `size` at every node but those of the lower block's foot, at z = -2 mm.
void shake(Model& model, double size) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<double> speed(-size, size);
  set_velocity(model, [&](const Vec3& x, int) {
    Vec3 v{};
    for (double& c : v) c = x[2] < -1.99e-3 ? 0 : speed(generator);
    return v;
  });
}

}  // namespace

TEST_CASE("an element's stable step is its smallest height over the speed of dilatational waves") {
  for (const Vec3& size : {Vec3{0.01, 0.01, 0.01}, Vec3{0.01, 0.03, 0.02}}) {
    Model model;
    build_model(block_scene(size, {1, 1, 1}, 1e-3), model);
    CHECK_THAT(model.stable_step.elements, WithinRel(0.01 / steel().dilatational_speed(), 1e-12));
    CHECK(model.stable_step.contact == 0);
    CHECK(model.stable_step.connector == 0);
    CHECK(model.step_size <= 0.9 * model.stable_step.limit * (1 + 1e-9));
    CHECK_THAT(model.step_size * static_cast<double>(model.step_count), WithinRel(1e-3, 1e-12));
  }
}

TEST_CASE("contact of matched 1 mm cubes allows 1/1.138 of their own step") {
  TwoBlocks blocks;
  blocks.upper_size = blocks.lower_size = {6e-3, 6e-3, 2e-3};
  blocks.upper_divisions = blocks.lower_divisions = {6, 6, 2};
  const scene::Scene scene = blocks.scene(1e-4);
  // Without the blocks' edges, where nodes are lighter, as on the inside of any surface.
  Assembly assembly = assemble(scene);
  keep_middle(assembly, "upper.z_min", 2.1e-3);
  keep_middle(assembly, "lower.z_max", 2.1e-3);
  Model model;
  build_model(scene, assembly, model);
  CHECK(model.contacts[0].slave_nodes.size() == 25);
  CHECK_THAT(model.stable_step.contact / model.stable_step.elements, WithinRel(1 / 1.138, 2e-3));
  // Contact is the shortest of the three; the blocks' free edges, as the assembled scene has them, take some more.
  CHECK(model.stable_step.limit <= model.stable_step.contact);
  CHECK(model.stable_step.limit > 0.85 * model.stable_step.contact);
}

TEST_CASE("matched blocks pressed together stay calm for 20000 steps of the program's own choice") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    TwoBlocks blocks;
    blocks.upper_size = blocks.lower_size = {3e-3, 3e-3, 2e-3};
    blocks.upper_divisions = blocks.lower_divisions = {3, 3, 2};
    blocks.friction = 0.3;
    scene::Scene scene = blocks.scene(1);
    for (scene::Part& part : scene.parts)
      set_hourglass(part, hourglass, hourglass == scene::HourglassType::viscous ? 0.1 : 0.05);
    scene.gravity = {0, 0, -1e7};
    hold(scene, "lower.z_min", {true, true, true});
    scene.settle.active = true;
    Model model;
    build_model(scene, model);
    const double weight = 1e7 * mass_of(model, "upper");
    REQUIRE(settle_whole(model).settled);
    shake(model, 1e-3);
    double fastest = 0;
    Vec3 mean_force{};
    const long steps = 20000;
    march(model, steps, [&] {
      if (model.step % 100 != 0) return;
      fastest = std::max(fastest, largest_speed(model));
      mean_force = mean_force + (1.0 / (steps / 100 + 1)) * contact_totals(model, model.contacts, 0).normal_force;
    });
    INFO("hourglass type " << static_cast<int>(hourglass) << ": fastest node " << fastest
                           << " m/s, mean contact force / weight " << mean_force[2] / weight
                           << ", contact step / element step "
                           << model.stable_step.contact / model.stable_step.elements);
    // What the shake and the end of the settling's hourglass support set in motion; an instability passes any bound.
    CHECK(fastest < 0.1);
    CHECK_THAT(mean_force[2], WithinRel(weight, 0.01));
  }
}
