#pragma once

#include "tests/verify/block.hpp"

/// What tests add to a scene. Each function returns the new entry, whose other values may then be set.
namespace railwave::verify {

inline scene::Constraint& hold(scene::Scene& scene, const std::string& target, std::array<bool, 3> fixed) {
  scene::Constraint& held = scene.constraints.emplace_back();
  held.name = "held " + target;
  held.target = target;
  held.fixed = fixed;
  return held;
}

/// Holds each of a block's lower faces along its normal: the block is free to contract.
inline void hold_lower_faces(scene::Scene& scene, const std::string& part) {
  hold(scene, part + ".x_min", {true, false, false});
  hold(scene, part + ".y_min", {false, true, false});
  hold(scene, part + ".z_min", {false, false, true});
}

inline scene::Load& add_load(scene::Scene& scene, scene::LoadType type, const std::string& target,
                             const std::string& curve = "") {
  scene::Load& load = scene.loads.emplace_back();
  load.name = "load on " + target;
  load.type = type;
  load.target = target;
  load.curve = curve;
  return load;
}

inline scene::Load& add_force(scene::Scene& scene, const std::string& target, const Vec3& force,
                              const std::string& curve = "") {
  scene::Load& load = add_load(scene, scene::LoadType::nodal_force, target, curve);
  load.force = force;
  return load;
}

inline scene::Load& add_pressure(scene::Scene& scene, const std::string& target, double pressure,
                                 const std::string& curve = "") {
  scene::Load& load = add_load(scene, scene::LoadType::pressure, target, curve);
  load.pressure = pressure;
  return load;
}

inline scene::Load& add_traction(scene::Scene& scene, const std::string& target, const Vec3& traction,
                                 const std::string& curve = "") {
  scene::Load& load = add_load(scene, scene::LoadType::traction, target, curve);
  load.traction = traction;
  return load;
}

inline scene::Load& add_torque(scene::Scene& scene, const std::string& target, double moment, const Vec3& axis) {
  scene::Load& load = add_load(scene, scene::LoadType::torque, target);
  load.moment = moment;
  load.axis = axis;
  return load;
}

inline scene::Curve& add_ramp(scene::Scene& scene, const std::string& name, double start, double duration) {
  scene::Curve& curve = scene.curves.emplace_back();
  curve.name = name;
  curve.type = scene::CurveType::cosine_ramp;
  curve.start = start;
  curve.duration = duration;
  return curve;
}

inline scene::PointMass& add_point(scene::Scene& scene, const std::string& name, double mass, const Vec3& position) {
  scene::PointMass& point = scene.points.emplace_back();
  point.name = name;
  point.mass = mass;
  point.position = position;
  return point;
}

inline scene::Connector& add_spring(scene::Scene& scene, const std::string& from, const std::string& to,
                                    const Vec3& stiffness, const Vec3& damping = {0, 0, 0}) {
  scene::Connector& spring = scene.connectors.emplace_back();
  spring.name = from + " to " + to;
  spring.from = from;
  spring.to = to;
  spring.stiffness = stiffness;
  spring.damping = damping;
  return spring;
}

/// Of parts and point masses, from the start.
inline scene::InitialMotion& add_motion(scene::Scene& scene, const std::vector<std::string>& parts,
                                        const Vec3& velocity, const Vec3& angular_velocity = {0, 0, 0}) {
  scene::InitialMotion& motion = scene.initial_motions.emplace_back();
  motion.name = "motion";
  motion.parts = parts;
  motion.velocity = velocity;
  motion.angular_velocity = angular_velocity;
  return motion;
}

/// A bar of 20 mm along x, free to contract, of a steel that yields.
inline scene::Scene yielding_bar(double yield_stress, double tangent_modulus, double end) {
  scene::Scene scene = block_scene({0.02, 0.01, 0.01}, {4, 2, 2}, end);
  scene.materials[0].yield_stress = yield_stress;
  scene.materials[0].tangent_modulus = tangent_modulus;
  hold_lower_faces(scene, "block");
  return scene;
}

}  // namespace railwave::verify
