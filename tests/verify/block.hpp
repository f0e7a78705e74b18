#pragma once

#include <functional>

#include "case/error.hpp"
#include "mesh/mesh.hpp"
#include "model/contact/contact_state.hpp"
#include "model/fields.hpp"
#include "model/host_copy.hpp"
#include "model/model.hpp"
#include "solve/monitor/account.hpp"
#include "solve/plan.hpp"
#include "solve/time_loop.hpp"

/// Small scenes that the verification tests are made of.
namespace railwave::verify {

inline scene::Material steel() {
  scene::Material material;
  material.name = "steel";
  material.youngs_modulus = 210e9;
  material.poissons_ratio = 0.3;
  material.density = 7800;
  return material;
}

/// What building a scene's model complains of; nothing when it suits.
inline std::string complaint_of_building(const scene::Scene& scene) {
  Model model;
  try {
    build_model(scene, model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// One box of steel, named "block", with the run's length given.
inline scene::Scene block_scene(const Vec3& size, const std::array<int, 3>& divisions, double end) {
  scene::Scene scene;
  scene.path = "block";
  scene.materials.push_back(steel());
  scene::MeshSource mesh;
  mesh.name = "block";
  mesh.type = scene::MeshType::box;
  mesh.box.size = size;
  mesh.box.divisions = divisions;
  scene.meshes.push_back(mesh);
  scene::Part part;
  part.name = "block";
  part.mesh = "block";
  part.material = "steel";
  part.take_hourglass(
      scene::HourglassType::viscous);  // what tolerances of older tests were found with; others say theirs
  scene.parts.push_back(part);
  scene.time.end = end;
  scene.output.history_interval = end;
  return scene;
}

inline scene::Part& set_hourglass(scene::Part& part, scene::HourglassType type, double coefficient) {
  part.hourglass = type;
  part.hourglass_coefficient = coefficient;
  return part;
}

/// Sets velocities node by node from the reference place.
inline void set_velocity(Model& model, const std::function<Vec3(const Vec3&, int)>& field) {
  const auto velocity = to_host(model.nodes.velocity);
  for (int n = 0; n < model.nodes.count; ++n) {
    const Vec3 v = field(model.assembly.nodes[n], n);
    for (int i = 0; i < 3; ++i) velocity(n, i) = v[i];
  }
  Kokkos::deep_copy(model.nodes.velocity, velocity);
}

/// Moves nodes from the reference place to where `field` says.
inline void set_position(Model& model, const std::function<Vec3(const Vec3&, int)>& field) {
  const auto position = to_host(model.nodes.position);
  for (int n = 0; n < model.nodes.count; ++n) {
    const Vec3 x = field(model.assembly.nodes[n], n);
    for (int i = 0; i < 3; ++i) position(n, i) = x[i];
  }
  Kokkos::deep_copy(model.nodes.position, position);
}

/// Computes the forces of the present instant.
inline void compute_forces(Model& model) {
  Instant instant;
  instant.step = model.step_size;
  StepPlans(model).compute_forces(instant, StepKind::sampled);
}

inline std::vector<int> all_elements(const Model& model) {
  std::vector<int> all(model.assembly.elements.size());
  for (std::size_t e = 0; e < all.size(); ++e) all[e] = static_cast<int>(e);
  return all;
}

inline std::vector<int> all_nodes(const Model& model) {
  std::vector<int> all(model.assembly.nodes.size());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n);
  return all;
}

/// Keeps every history sample.
struct Recorder : RunObserver {
  std::vector<HistorySample> samples;
  void history(const Model&, const HistorySample& sample) override { samples.push_back(sample); }
};

}  // namespace railwave::verify
