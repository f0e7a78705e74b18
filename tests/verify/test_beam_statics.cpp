#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/beam_scene.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double radius = 0.03, length = 1.2;

/// A cantilever, settled under its loads.
void settle_cantilever(scene::Scene& scene, Model& model) {
  clamp(scene, "root");
  scene.settle.active = true;
  scene.settle.tolerance = 1e-7;
  scene.settle.max_steps = 400000;
  build_model(scene, model);
  REQUIRE(settle_whole(model).settled);
}

struct Theory {
  double EI, shear, twist;
};

Theory theory() {
  const double A = M_PI * radius * radius, I = M_PI / 4 * std::pow(radius, 4), G = 210e9 / 2.6;
  return {210e9 * I, 6 * 1.3 / 8.8 * G * A, G * 2 * I};
}

}  // namespace

TEST_CASE("a cantilever of one element or ten bends as Timoshenko's under a force at its tip") {
  const auto axes = oblique_axes();
  const auto [EI, shear, twist] = theory();
  const double force = 1000;
  for (int divisions : {1, 10}) {
    scene::Scene scene = beam_scene(length * axes[0], radius, divisions, 1e-3);
    Model model;
    add_force(scene, "tip", force * axes[1]);
    settle_cantilever(scene, model);
    CHECK_THAT(dot(displacement(model, "tip"), axes[1]),
               WithinRel(force * std::pow(length, 3) / (3 * EI) + force * length / shear, 1e-3));
    CHECK_THAT(dot(rotation(model, "tip"), axes[2]), WithinRel(force * length * length / (2 * EI), 1e-3));
    compute_forces(model);
    const BeamResultants sections = beam_resultants(*model.beams, model.nodes).front();
    const double lever = length * (1 - 0.5 / divisions);
    CHECK_THAT(std::hypot(sections.force[1], sections.force[2]), WithinRel(force, 1e-3));
    CHECK_THAT(std::hypot(sections.moment[1], sections.moment[2]), WithinRel(force * lever, 1e-3));
  }
}

TEST_CASE("a moment at the tip bends a beam to an arc of a circle, even a quarter of one") {
  const auto axes = oblique_axes();
  const auto [EI, shear, twist] = theory();
  const double angle = M_PI / 2, moment = EI * angle / length;
  scene::Scene scene = beam_scene(length * axes[0], radius, 16, 1e-3);
  Model model;
  add_torque(scene, "tip", moment, axes[2]);
  settle_cantilever(scene, model);
  CHECK_THAT(dot(rotation(model, "tip"), axes[2]), WithinRel(angle, 1e-5));
  // Chords are shorter than arcs by a part in 24 of an element's squared angle.
  const Vec3 u = displacement(model, "tip");
  CHECK_THAT(length + dot(u, axes[0]), WithinRel(length / angle * std::sin(angle), 1e-3));
  CHECK_THAT(dot(u, axes[1]), WithinRel(length / angle * (1 - std::cos(angle)), 1e-3));
}

TEST_CASE("a torque about a beam twists it by M L / (G J), a pull stretches it by F L / (E A)") {
  const auto axes = oblique_axes();
  const auto [EI, shear, twist] = theory();
  {
    scene::Scene scene = beam_scene(length * axes[0], radius, 10, 1e-3);
    Model model;
    add_torque(scene, "tip", 500, axes[0]);
    settle_cantilever(scene, model);
    CHECK_THAT(dot(rotation(model, "tip"), axes[0]), WithinRel(500 * length / twist, 1e-5));
    CHECK_THAT(norm(displacement(model, "tip")), WithinAbs(0, 1e-9 * length));
  }
  scene::Scene scene = beam_scene(length * axes[0], radius, 10, 1e-3);
  Model model;
  add_force(scene, "tip", 1e5 * axes[0]);
  settle_cantilever(scene, model);
  CHECK_THAT(dot(displacement(model, "tip"), axes[0]),
             WithinRel(1e5 * length / (210e9 * M_PI * radius * radius), 1e-5));
}

TEST_CASE("a rectangle bends along its height and across it, each with its own stiffness") {
  const double width = 0.02, height = 0.05, force = 20;
  for (int direction : {1, 2}) {
    scene::Scene scene = beam_scene({length, 0, 0}, 0, 10, 1e-3);
    scene::Beam& beam = scene.beams.front();
    beam.section = scene::BeamSection::rectangle;
    beam.width = width;
    beam.height = height;
    beam.orientation = Vec3{0.3, 0, 1};
    Model model;
    Vec3 load{0, 0, 0};
    load[direction] = force;
    add_force(scene, "tip", load);
    settle_cantilever(scene, model);
    const double I = direction == 2 ? width * std::pow(height, 3) / 12 : height * std::pow(width, 3) / 12;
    const double shear = 13 / 15.3 * (210e9 / 2.6) * width * height;
    CHECK_THAT(displacement(model, "tip")[direction],
               WithinRel(force * std::pow(length, 3) / (3 * 210e9 * I) + force * length / shear, 1e-3));
    CHECK_THAT(displacement(model, "tip")[3 - direction], WithinAbs(0, 1e-12));
  }
}

TEST_CASE("the torsion constant of a rectangle is Saint-Venant's") {
  // Timoshenko and Goodier 1970, table of k1: J = k1 h b^3.
  for (const auto& [ratio, constant] : {std::pair{1.0, 0.1406}, {2.0, 0.229}, {4.0, 0.281}, {10.0, 0.312}}) {
    scene::Beam beam;
    beam.section = scene::BeamSection::rectangle;
    beam.width = 0.01;
    beam.height = 0.01 * ratio;
    CHECK_THAT(section_values(beam, steel()).torsion, WithinRel(constant * beam.height * 1e-6, 5e-3));
  }
}
