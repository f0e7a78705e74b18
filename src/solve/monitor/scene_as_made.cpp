#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/sets/place_sets.hpp"
#include "solve/monitor/monitor.hpp"

namespace railwave {
namespace {

/// Strain that elements in single precision see at most where bodies travel and there is none.
constexpr double strain_of_rounding = 8 * 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());

Extreme smallest_jacobian(const Assembly& assembly) {
  Extreme worst;
  for (int e = 0; e < static_cast<int>(assembly.elements.size()); ++e) {
    const double mean = hexahedron_volume(corners_of(assembly.nodes, assembly.elements[e])) / 8;
    const double jacobian = undeformed_shape(assembly, e).smallest_jacobian();
    if (e == 0 || jacobian / mean < worst.value) worst = {jacobian / mean, e};
  }
  return worst;
}

double rounding_energy(const AssembledScene& assembled) {
  double energy = 0;
  if (assembled.scene.solver.elements_in_single())
    for (const auto& part : assembled.assembly.parts)
      for (int e = part.first_element; e < part.first_element + part.element_count; ++e)
        energy += 0.5 * assembled.scene.materials[part.material].dilatational_modulus() * strain_of_rounding *
                  strain_of_rounding *
                  hexahedron_volume(corners_of(assembled.assembly.nodes, assembled.assembly.elements[e]));
  return energy;
}

/// m
double largest_coordinate(const Assembly& assembly) {
  double largest = 0;
  for (const Vec3& place : assembly.nodes)
    for (double x : place) largest = std::max(largest, std::fabs(x));
  return largest;
}

/// Gravity's work and the springs' energy go by places, kinetic energy by velocities: in a step they part by these
/// forces times half a unit in the last place.
double place_energy(const AssembledScene& assembled) {
  double force = 0;  // N
  for (double mass : assembled.mass) force += mass * length(assembled.scene.gravity);
  for (const scene::Connector& connector : assembled.scene.connectors) force += length(connector.preload);
  return force * 0.5 * std::numeric_limits<double>::epsilon() * largest_coordinate(assembled.assembly);
}

double rest_energy(const AssembledScene& assembled) {
  const double largest = largest_coordinate(assembled.assembly);
  double energy = 0;
  for (const auto& part : assembled.assembly.parts)
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e) {
      const double strain = 8 * 0.5 * std::numeric_limits<double>::epsilon() * largest / assembled.element_length[e];
      energy += 0.5 * assembled.scene.materials[part.material].dilatational_modulus() * strain * strain *
                hexahedron_volume(corners_of(assembled.assembly.nodes, assembled.assembly.elements[e]));
    }
  return energy;
}

template <class Placed>
std::vector<std::string> warnings_of(const std::vector<Placed>& sets) {
  std::vector<std::string> warnings;
  for (const Placed& placed : sets)
    if (!placed.warning.empty()) warnings.push_back(placed.warning);
  return warnings;
}

}  // namespace

SceneAsMade::SceneAsMade(const AssembledScene& assembled)
    : node_set_warnings(warnings_of(placed_sets(assembled.scene, assembled.assembly))),
      element_set_warnings(warnings_of(placed_element_sets(assembled.scene, assembled.assembly))) {
  if (!assembled.scene.monitor.active) return;
  worst_shape = smallest_jacobian(assembled.assembly);
  energy_of_rounding = rounding_energy(assembled);
  energy_of_rest = rest_energy(assembled);
  energy_of_places = place_energy(assembled);
}

}  // namespace railwave
