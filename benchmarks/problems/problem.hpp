#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "benchmarks/common/loop.hpp"
#include "benchmarks/common/scenes.hpp"
#include "model/fields.hpp"
#include "model/host_copy.hpp"

/// Problems whose solution is known, for run time against error.
namespace railwave::bench {

/// How a problem is solved.
struct Method {
  Choice choice;
  double hourglass_coefficient = 0;   ///< 0: the program's own for viscous control, 0.05 for stiffness
  std::string step_rule = "element";  ///< or "eigenvalue", "global"
  double step_scale = 0.9;
  double penalty_scale = 1;
  scene::ContactAlgorithm contact = scene::ContactAlgorithm::penalty;
  bool subcycling = false;
};

/// What came out.
struct Outcome {
  long elements = 0, steps = 0;
  double seconds = 0;  ///< wall time of the steps, building left out
  double error = 0;    ///< the problem's own measure, relative
  std::vector<std::pair<std::string, double>> details;
};

inline constexpr double pi = 3.14159265358979323846;

/// Puts a method into a scene of one part. Throws InputError when this build does not know it.
inline void apply(const Method& method, scene::Scene& scene) {
  scene::Part& part = scene.parts[0];
  part.hourglass_coefficient = method.hourglass_coefficient > 0                  ? method.hourglass_coefficient
                               : part.hourglass == scene::HourglassType::viscous ? 0.1
                                                                                 : 0.05;
  scene.solver.step_estimate = scene::StepEstimate::element;
  if (method.step_rule == "eigenvalue") scene.solver.step_estimate = scene::StepEstimate::eigenvalue;
  if (method.step_rule == "global") scene.solver.step_estimate = scene::StepEstimate::global;
  scene.time.step_scale = method.step_scale;
  scene.solver.subcycling = method.subcycling;
}

inline void hold(scene::Scene& scene, const std::string& target, const std::array<bool, 3>& fixed) {
  scene::Constraint held;
  held.name = "held " + target;
  held.target = target;
  held.fixed = fixed;
  scene.constraints.push_back(held);
}

inline void set_position(Model& model, const std::function<Vec3(const Vec3&)>& place) {
  const auto position = to_host(model.nodes.position);
  for (int n = 0; n < model.nodes.count; ++n) {
    const Vec3 x = place(model.assembly.nodes[n]);
    for (int i = 0; i < 3; ++i) position(n, i) = x[i];
  }
  Kokkos::deep_copy(model.nodes.position, position);
}

inline std::vector<int> all_nodes(const Model& model) {
  std::vector<int> all(model.assembly.nodes.size());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n);
  return all;
}

/// Square root of sum m |u - exact|^2 over sum m |exact|^2, over all nodes. @param exact field by reference place
inline double relative_error(const Model& model, NodeField field, const std::function<Vec3(const Vec3&)>& exact) {
  const auto values = node_field(model, model.ties, field, all_nodes(model)).values;
  double off = 0, size = 0;
  for (int n = 0; n < model.nodes.count; ++n) {
    const Vec3 right = exact(model.assembly.nodes[n]);
    for (int i = 0; i < 3; ++i) {
      off += model.mass[n] * std::pow(values[3 * n + i] - right[i], 2);
      size += model.mass[n] * right[i] * right[i];
    }
  }
  return std::sqrt(off / size);
}

}  // namespace railwave::bench
