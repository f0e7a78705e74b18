#pragma once

#include "benchmarks/baseline.hpp"
#include "mesh/hexahedron.hpp"
#include "model/host_copy.hpp"
#include "model/model.hpp"

namespace railwave::bench {

/// The baseline of a model of one elastic part, at rest; an eighth of each element's mass on each of its corners.
inline Baseline build_baseline(const Model& model) {
  const scene::Material& material = model.scene.materials[0];
  const Assembly& assembly = model.assembly;
  Baseline b;
  b.element_count = static_cast<int>(assembly.elements.size());
  b.node_count = static_cast<int>(assembly.nodes.size());
  b.mu = material.shear_modulus();
  b.lambda = material.dilatational_modulus() - 2 * b.mu;
  b.density = material.density;
  b.sound_speed = material.dilatational_speed();
  b.hourglass_coefficient = model.scene.parts[0].hourglass_coefficient;
  b.corners = to_device("baseline corners", assembly.elements);
  b.position = to_device("baseline position", assembly.nodes);
  b.stress = Array<double* [6]>("baseline stress", b.element_count);
  b.velocity = Array<double* [3]>("baseline velocity", b.node_count);
  b.force = Array<double* [3]>("baseline force", b.node_count);
  std::vector<double> mass(assembly.nodes.size(), 0);
  for (const auto& element : assembly.elements) {
    double volume = 0;
    for (double share : hexahedron_shape_integrals(corners_of(assembly.nodes, element))) volume += share;
    for (int n : element) mass[n] += material.density * volume / 8;
  }
  b.mass = to_device("baseline mass", mass);
  return b;
}

}  // namespace railwave::bench
