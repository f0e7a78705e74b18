#pragma once

#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

namespace railwave::verify {

inline constexpr auto both_algorithms = {scene::ContactAlgorithm::penalty, scene::ContactAlgorithm::multiplier};

inline const char* name_of(scene::ContactAlgorithm algorithm) {
  return algorithm == scene::ContactAlgorithm::penalty ? "penalty" : "multiplier";
}

/// A block on a larger one, both about the z axis: "upper" on "lower", touching planes at z = 0, contact "touch" with
/// the upper block as slave.
struct TwoBlocks {
  Vec3 upper_size{0.04, 0.04, 0.01}, lower_size{0.08, 0.08, 0.02};
  std::array<int, 3> upper_divisions{8, 8, 2}, lower_divisions{16, 16, 4};
  double gap = 0;  ///< m, before the run
  double friction = 0;
  scene::ContactAlgorithm algorithm = scene::ContactAlgorithm::penalty;

  scene::Scene scene(double end) const {
    scene::Scene made = block_scene(upper_size, upper_divisions, end);
    made.path = "two blocks";
    made.parts[0].name = made.parts[0].mesh = made.meshes[0].name = "upper";
    made.parts.push_back(made.parts[0]);
    made.meshes.push_back(made.meshes[0]);
    made.parts[1].name = made.parts[1].mesh = made.meshes[1].name = "lower";
    made.meshes[1].box.size = lower_size;
    made.meshes[1].box.divisions = lower_divisions;
    made.parts[0].position = {-0.5 * upper_size[0], -0.5 * upper_size[1], gap};
    made.parts[1].position = {-0.5 * lower_size[0], -0.5 * lower_size[1], -lower_size[2]};
    scene::Contact contact;
    contact.name = "touch";
    contact.slave = "upper.z_min";
    contact.master = "lower.z_max";
    contact.friction = friction;
    contact.algorithm = algorithm;
    made.contacts.push_back(contact);
    return made;
  }
};

/// Two blocks with friction, damping, a torque, a force and a spring: most of what a step can have.
inline scene::Scene busy_blocks(TwoBlocks blocks = {}) {
  blocks.friction = 0.3;
  scene::Scene scene = blocks.scene(1e-4);
  hold(scene, "lower.z_min", {true, true, true});
  scene.parts[1].stiffness_damping = 1e-8;
  add_torque(scene, "upper.z_max", 40, {0, 0, 1});
  add_force(scene, "upper.z_max", {0, 0, -1e4});
  add_spring(scene, "ground", "upper.z_max", {1e6, 2e6, 3e6});
  return scene;
}

/// Two blocks without contact, the upper one of a material whose yield stress is beyond all stresses of the tests.
inline scene::Scene blocks_of_two_materials(scene::Precision precision) {
  scene::Scene scene = TwoBlocks{}.scene(1e-5);
  scene.contacts.clear();
  scene.solver.precision = precision;
  scene.materials.push_back(steel());
  scene.materials[1].name = "yielding";
  scene.materials[1].yield_stress = 1e12;
  scene.materials[1].tangent_modulus = 1e9;
  scene.parts[0].material = "yielding";
  return scene;
}

inline double mass_of(const Model& model, const std::string& set) {
  double sum = 0;
  for (int n : model.assembly.node_sets.at(set)) sum += model.mass[n];
  return sum;
}

/// How far from equal and opposite a pair's forces are, relative to their size.
inline double reaction_error(const ContactTotals& totals) {
  const Vec3 slave = totals.normal_force + totals.tangential_force;
  return norm(slave) > 0 ? norm(slave + totals.master_force) / norm(slave) : norm(totals.master_force);
}

}  // namespace railwave::verify
