#pragma once

#include "model/beams/beam_section.hpp"
#include "model/beams/beams.hpp"
#include "solve/tasks/beam_forces.hpp"
#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

/// Scenes with beams, and what the tests measure on them.
namespace railwave::verify {

inline scene::PointMass massless(const std::string& name, const Vec3& position) {
  scene::PointMass made;
  made.name = name;
  made.position = position;
  return made;
}

inline scene::Beam round_beam(const std::string& from, const std::string& to, double radius, int divisions) {
  scene::Beam made;
  made.name = from + "_to_" + to;
  made.from = from;
  made.to = to;
  made.material = "steel";
  made.radius = radius;
  made.divisions = divisions;
  return made;
}

/// A beam of steel from point "root" at the origin to point "tip".
inline scene::Scene beam_scene(const Vec3& tip, double radius, int divisions, double end) {
  scene::Scene scene;
  scene.path = "beam";
  scene.materials.push_back(steel());
  scene.points = {massless("root", {0, 0, 0}), massless("tip", tip)};
  scene.beams.push_back(round_beam("root", "tip", radius, divisions));
  scene.time.end = end;
  scene.output.history_interval = end;
  return scene;
}

/// A cube with a bolt through it: a shank under tension between two points above and below, each with a beam to every
/// node of the cube's face there.
inline scene::Scene bolted_cube(double pretension, double end) {
  scene::Scene scene = block_scene({0.08, 0.08, 0.08}, {4, 4, 4}, end);
  scene.points = {massless("head", {0.04, 0.04, 0.1}), massless("nut", {0.04, 0.04, -0.02})};
  scene::Beam shank = round_beam("nut", "head", 0.012, 4);
  shank.name = "shank";
  shank.pretension = pretension;
  scene.beams = {shank, round_beam("head", "block.z_max", 0.01, 1), round_beam("nut", "block.z_min", 0.01, 1)};
  scene.beams[1].name = "washer_above";
  scene.beams[2].name = "washer_below";
  return scene;
}

inline void clamp(scene::Scene& scene, const std::string& point) {
  hold(scene, point, {true, true, true}).fixed_rotation = {true, true, true};
}

inline int node_of(const Model& model, const std::string& point) { return model.assembly.node_sets.at(point).front(); }

inline Vec3 displacement(const Model& model, const std::string& point) {
  return mean(model, NodeField::displacement, {node_of(model, point)});
}

/// Rotation vector of a point where beams end, rad, for angles up to half a turn.
inline Vec3 rotation(const Model& model, const std::string& point) {
  const int b = model.beams->number[node_of(model, point)];
  const auto q = to_host(model.beams->arrays.rotation);
  const Vec3 v{q(b, 1), q(b, 2), q(b, 3)};
  const double sine = norm(v);
  return sine > 0 ? (2 * std::atan2(sine, q(b, 0)) / sine) * v : Vec3{0, 0, 0};
}

struct Momenta {
  Vec3 linear{}, angular{};
};

/// Of nodes and rotations, about the origin, half a step before the present instant.
inline Momenta momenta(const Model& model) {
  Momenta sum;
  const auto x = to_host(model.nodes.position), v = to_host(model.nodes.velocity);
  for (int n = 0; n < model.nodes.count; ++n) {
    const Vec3 p = model.mass[n] * Vec3{v(n, 0), v(n, 1), v(n, 2)};
    sum.linear = sum.linear + p;
    sum.angular = sum.angular + cross({x(n, 0), x(n, 1), x(n, 2)}, p);
  }
  if (!model.beams) return sum;
  const auto w = to_host(model.beams->arrays.spin);
  const auto inertia = to_host(model.beams->arrays.inertia);
  for (int b = 0; b < model.beams->arrays.node_count; ++b)
    sum.angular = sum.angular + inertia(b) * Vec3{w(b, 0), w(b, 1), w(b, 2)};
  return sum;
}

/// The largest of a beam's section forces and moments.
inline double largest_of(const BeamResultants& beam) {
  double largest = 0;
  for (const auto* values : {&beam.force, &beam.moment})
    for (double value : *values) largest = std::max(largest, std::fabs(value));
  return largest;
}

}  // namespace railwave::verify
