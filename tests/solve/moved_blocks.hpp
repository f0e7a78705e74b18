#pragma once

#include <vector>

#include "model/host_copy.hpp"
#include "model/model.hpp"
#include "tests/verify/open_ends.hpp"
#include "tests/verify/tied_blocks.hpp"

namespace railwave::verify {

/// Most of what a step can have: besides busy_blocks' a load that grows, a pressure, two motions that are prescribed of
/// the same nodes.
inline scene::Scene moved_blocks() {
  scene::Scene scene = busy_blocks();
  add_ramp(scene, "grows", 0, 6e-5);
  scene.loads[0].curve = scene.loads[1].curve = "grows";
  add_pressure(scene, "upper.x_min", 1e6, "grows");
  scene::PrescribedMotion& motion = scene.prescribed_motions.emplace_back();
  motion.name = "pushed";
  motion.target = "lower.x_max";
  motion.velocity = {-0.05, 0, 0};
  motion.curve = "grows";
  motion.directions = {true, false, false};
  scene.prescribed_motions.push_back(motion);
  scene.prescribed_motions[1].name = "lifted";
  scene.prescribed_motions[1].velocity = {0, 0, 0.02};
  scene.prescribed_motions[1].curve.clear();
  scene.prescribed_motions[1].directions = {false, false, true};
  scene.constraints.clear();
  hold(scene, "lower.x_min", {true, true, true});
  return scene;
}

/// The same blocks with motions prescribed of nodes that no multipliers push: of one set under load, of one without.
inline scene::Scene driven_apart(scene::Scene scene) {
  scene.contacts[0].algorithm = scene::ContactAlgorithm::multiplier;
  scene.constraints.clear();
  scene.prescribed_motions[0].target = "lower.z_min";
  scene.prescribed_motions[1].target = "upper.z_max";
  return scene;
}

/// A lower block of large elements, which take longer steps than the upper one's.
inline scene::Scene on_coarse_block(scene::Scene scene) {
  scene.meshes[1].box.size = {0.16, 0.16, 0.48};
  scene.meshes[1].box.divisions = {8, 8, 24};
  scene.parts[1].position = {-0.08, -0.08, -0.48};
  scene.solver.subcycling = true;
  scene.time.end *= 2;  // multipliers have longer steps than springs
  return scene;
}

/// Tied blocks that loads press and pull, with a non-reflecting end.
inline scene::Scene tied_and_open(const TiedBlocks& blocks) {
  scene::Scene scene = blocks.scene(4e-4);
  add_ramp(scene, "grows", 0, 6e-5);
  add_pressure(scene, "fine.z_max", 1e7, "grows");
  add_force(scene, "coarse.x_max", {2e3, 1e3, 0}, "grows");
  add_dashpots(scene, "coarse.z_min");
  return scene;
}

/// Where a run has left its nodes.
struct End {
  std::vector<double> position, velocity;
  long steps;
};

inline End end_of(const Model& model) {
  const auto position = to_host(model.nodes.position), velocity = to_host(model.nodes.velocity);
  End end{{}, {}, model.step};
  for (int n = 0; n < model.nodes.count; ++n)
    for (int k = 0; k < 3; ++k) {
      end.position.push_back(position(n, k));
      end.velocity.push_back(velocity(n, k));
    }
  return end;
}

}  // namespace railwave::verify
