#pragma once

#include "benchmarks/common/scenes.hpp"
#include "benchmarks/stability/distortions.hpp"

namespace railwave::bench {

inline constexpr double millimetre = 1e-3;

/// Hourglass control of a part.
struct Control {
  scene::HourglassType type;
  double coefficient;
  const char* name() const { return type == scene::HourglassType::viscous ? "viscous" : "stiffness"; }
};

/// A scene and the assembly that its model is built of.
struct Setup {
  scene::Scene scene;
  Assembly assembly;
};

inline Setup body(const Distortion& distortion, const Control& control, const std::string& precision) {
  const auto& n = distortion.divisions;
  Setup made;
  made.scene = block_scene({n[0] * distortion.size[0], n[1] * distortion.size[1], n[2] * distortion.size[2]}, n,
                           {"viscous", precision, "elastic"});
  made.scene.parts[0].hourglass = control.type;
  made.scene.parts[0].hourglass_coefficient = control.coefficient;
  made.assembly = assemble(made.scene);
  distort(distortion, made.assembly);
  return made;
}

/// Two blocks pressed on one another along z.
struct Pressing {
  std::string name;
  std::array<int, 3> upper, lower;                          ///< divisions
  double upper_size = millimetre, lower_size = millimetre;  ///< m, edges along x and y
  double height = millimetre;                               ///< m, of an element
  double friction = 0;
  bool symmetric = false;
};

inline std::vector<Pressing> pressings() {
  const double h = millimetre;
  return {
      {"matched", {4, 4, 3}, {6, 6, 3}},
      {"finer slave", {8, 8, 3}, {6, 6, 3}, h / 2, h, h},
      {"coarser slave", {3, 3, 3}, {8, 8, 3}, h, h / 2, h},
      {"nodes between nodes", {3, 3, 3}, {5, 5, 3}, 0.9 * h, h},
      {"flat elements", {4, 4, 3}, {6, 6, 3}, h, h, h / 4},
      {"tall elements", {4, 4, 3}, {6, 6, 3}, h, h, 3 * h},
      {"plate on plate", {5, 5, 1}, {7, 7, 1}},
      {"with friction", {4, 4, 3}, {6, 6, 3}, h, h, h, 0.4},
      {"symmetric", {4, 4, 3}, {6, 6, 3}, h, h, h, 0, true},
  };
}

/// @param pressure Pa, on the upper block's far side; the lower one's is held; the upper one reaches nowhere beyond the
/// lower
inline Setup pressed(const Pressing& pressing, const Control& control, double penalty_scale, double pressure,
                     const std::string& precision) {
  const auto size = [&](double edge, const std::array<int, 3>& n) {
    return Vec3{n[0] * edge, n[1] * edge, n[2] * pressing.height};
  };
  const Vec3 upper = size(pressing.upper_size, pressing.upper), lower = size(pressing.lower_size, pressing.lower);
  Setup made;
  scene::Scene& scene = made.scene;
  scene = block_scene(upper, pressing.upper, {"viscous", precision, "elastic"});
  scene.path = "pressed blocks";
  scene.parts[0].hourglass = control.type;
  scene.parts[0].hourglass_coefficient = control.coefficient;
  scene.parts[0].name = scene.parts[0].mesh = scene.meshes[0].name = "upper";
  scene.parts.push_back(scene.parts[0]);
  scene.meshes.push_back(scene.meshes[0]);
  scene.parts[1].name = scene.parts[1].mesh = scene.meshes[1].name = "lower";
  scene.meshes[1].box.size = lower;
  scene.meshes[1].box.divisions = pressing.lower;
  scene.parts[0].position = {-0.5 * upper[0], -0.5 * upper[1], 0};
  scene.parts[1].position = {-0.5 * lower[0], -0.5 * lower[1], -lower[2]};
  scene::Contact contact;
  contact.name = "touch";
  contact.slave = "upper.z_min";
  contact.master = "lower.z_max";
  contact.friction = pressing.friction;
  contact.symmetric = pressing.symmetric;
  contact.algorithm = scene::ContactAlgorithm::penalty;
  contact.penalty_scale = penalty_scale;
  scene.contacts.push_back(contact);
  const auto hold = [&](const std::string& target, const std::array<bool, 3>& fixed) {
    scene::Constraint held;
    held.name = held.target = target;
    held.fixed = fixed;
    scene.constraints.push_back(held);
  };
  hold("lower.z_min", {true, true, true});
  hold("upper.z_max", {true, true, false});  // nothing else keeps it from sliding off
  scene::Load load;
  load.name = "press";
  load.type = scene::LoadType::pressure;
  load.target = "upper.z_max";
  load.pressure = pressure;
  scene.loads.push_back(load);
  made.assembly = assemble(scene);
  return made;
}

}  // namespace railwave::bench
