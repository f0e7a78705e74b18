#pragma once

#include <functional>

#include "tests/verify/beam_scene.hpp"
#include "tests/verify/two_blocks.hpp"

/// Scenes with something wrong on purpose, and how they are run.
namespace railwave::verify {

struct Seed {
  std::string what, cause;  ///< what is wrong, and the name by which the monitor must call it
  scene::Scene scene;
  std::function<void(Model&)> spoil = {};    ///< after building
  std::function<void(Assembly&)> mesh = {};  ///< before
};

/// As if the estimate had been wrong: the case reader and the builder refuse such a step.
inline std::function<void(Model&)> step(double factor, double (*of)(const Model&)) {
  return [=](Model& model) { model.step_size = factor * of(model); };
}
inline double element_height(const Model& model) { return model.stable_step.elements; }
inline double element_free(const Model& model) {
  return model.element_length[0] / model.scene.materials[0].dilatational_speed();
}
inline double allowed(const Model& model) { return model.stable_step.limit; }

/// A block of steel that stands on held nodes, pressed from above.
inline scene::Scene pressed_block(double pressure = 1e6) {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {5, 5, 5}, 1);
  hold(scene, "block.z_min", {true, true, true});
  add_pressure(scene, "block.z_max", pressure);
  return scene;
}

inline scene::Scene pressed_blocks(double penalty_scale, double pressure = 1e7) {
  TwoBlocks blocks;
  blocks.upper_divisions = {4, 4, 2};
  blocks.lower_divisions = {8, 8, 3};
  scene::Scene scene = blocks.scene(1);
  scene.contacts[0].penalty_scale = penalty_scale;
  hold(scene, "lower.z_min", {true, true, true});
  add_pressure(scene, "upper.z_max", pressure);
  return scene;
}

/// A pressed block, and a small mass that flies into a spring and dashpot.
inline scene::Scene sprung_mass(double stiffness, double damping) {
  scene::Scene scene = pressed_block();
  add_point(scene, "ball", 0.01, {0, 0, 1});
  add_spring(scene, "ground", "ball", {stiffness, 0, 0}, {damping, 0, 0});
  add_motion(scene, {"ball"}, {1, 0, 0});
  return scene;
}

inline scene::Scene bent_beam() {
  scene::Scene scene = beam_scene({1, 0, 0}, 0.02, 8, 1);
  clamp(scene, "root");
  add_force(scene, "tip", {0, 0, 100});
  return scene;
}

template <class Change>
scene::Scene changed(scene::Scene scene, const Change& change) {
  change(scene);
  return scene;
}

inline scene::Scene spun_block() {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {4, 4, 4}, 1);
  add_torque(scene, "block.z_max", 3000, {0, 0, 1});
  return scene;
}

inline std::vector<Seed> seeds() {
  using scene::Scene;
  const auto part = [](scene::HourglassType type, double coefficient) {
    return [=](Scene& scene) { set_hourglass(scene.parts[0], type, coefficient); };
  };
  std::vector<Seed> all;
  all.push_back({"step 1.05 times the elements'", "step beyond elements", pressed_block(), step(1.05, element_height)});
  all.push_back({"step 3 times the elements'", "step beyond elements", pressed_block(), step(3, element_height)});
  all.push_back(
      {"step 1.3 times the contact springs'", "step beyond contact springs", pressed_blocks(20), step(1.3, allowed)});
  all.push_back({"penalty scale 100 with the step of 1", "step beyond contact springs", pressed_blocks(100),
                 step(0.9, element_height)});
  all.push_back({"step 1.2 times a spring's", "step beyond spring", sprung_mass(1e12, 0), step(1.2, allowed)});
  all.push_back({"step 1.5 times a dashpot's", "step beyond dashpot", sprung_mass(1e6, 1e5), step(1.5, allowed)});
  all.push_back({"step 1.5 times the beams'", "step beyond beams", bent_beam(), step(1.5, allowed)});
  all.push_back({"viscous hourglass coefficient 1", "hourglass control too strong",
                 changed(pressed_block(), part(scene::HourglassType::viscous, 1)), step(0.9, element_free)});
  all.push_back({"stiffness hourglass coefficient 5", "hourglass control too strong",
                 changed(pressed_block(), part(scene::HourglassType::stiffness, 5)), step(0.9, element_free)});
  all.push_back({"stiffness damping with the undamped step", "damping of a part",
                 changed(pressed_block(), [](Scene& scene) { scene.parts[0].stiffness_damping = 1e-4; }),
                 step(0.9, element_free)});
  all.push_back({"no hourglass control under a point load", "no hourglass control",
                 changed(block_scene({0.1, 0.1, 0.02}, {10, 10, 2}, 1), [](Scene& scene) {
                   set_hourglass(scene.parts[0], scene::HourglassType::viscous, 0);
                   hold(scene, "block.x_min", {true, true, true});
                   scene::NodeSet corner;
                   corner.name = "corner";
                   corner.part = "block";
                   corner.position = scene::Vec3{0.1, 0.1, 0.02};
                   scene.node_sets.push_back(corner);
                   add_force(scene, "block.corner", {0, 0, 2000});
                 })});
  all.push_back({"pressure of five times Young's modulus", "load", pressed_block(1e12)});
  all.push_back({"force a million times too large", "load", changed(pressed_block(), [](Scene& scene) {
                   scene.loads.clear();
                   add_force(scene, "block.z_max", {0, 0, -1e4 * 1e6});
                 })});
  all.push_back({"an element nearly flat at a corner", "mesh", pressed_block(), {}, [](Assembly& assembly) {
                   const auto& element = assembly.elements[62];
                   // Down its edge, towards the diagonal of its neighbours.
                   Vec3 mean{};
                   for (int k : {1, 3, 4})
                     for (int i = 0; i < 3; ++i) mean[i] += assembly.nodes[element[k]][i] / 3;
                   for (int i = 0; i < 3; ++i)
                     assembly.nodes[element[0]][i] += 0.985 * (mean[i] - assembly.nodes[element[0]][i]);
                 }});
  all.push_back({"half a face of initial penetration", "initial penetration",
                 changed(pressed_blocks(1), [](Scene& scene) { scene.parts[0].position[2] = -0.004; })});
  all.push_back({"springs of contact a thousandth as stiff", "soft penalty", pressed_blocks(1e-4, 2e8)});
  all.push_back({"velocity in mm/s", "speed", changed(pressed_block(), [](Scene& scene) {
                   scene.constraints.clear();
                   add_motion(scene, {"block"}, {30000, 0, 0});
                 })});
  all.push_back({"a curve's value that is no number", "curve", changed(pressed_block(), [](Scene& scene) {
                   scene::Curve curve;
                   curve.name = "measured";
                   curve.type = scene::CurveType::table;
                   curve.points = {{0, 0}, {1e-4, 1}, {2e-4, std::nan("")}, {1, 1}};
                   scene.curves.push_back(curve);
                   scene.loads[0].curve = "measured";
                 })});
  all.push_back({"density in tonnes per mm3", "material",
                 changed(pressed_block(), [](Scene& scene) { scene.materials[0].density = 7.8e-9; })});
  all.push_back({"torque on a block that nothing holds", "unheld", spun_block()});
  return all;
}

}  // namespace railwave::verify
