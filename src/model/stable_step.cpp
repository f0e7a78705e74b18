#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "model/build_steps.hpp"

namespace railwave {
namespace {

/// Stable step of each element, V / (A_max C_d).
std::vector<double> element_steps(const Model& model) {
  std::vector<double> steps(model.element_length.size());
  for (const auto& part : model.assembly.parts) {
    const double speed = model.scene.materials[part.material].dilatational_speed();
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e)
      steps[e] = model.element_length[e] / speed;
  }
  return steps;
}

/// Smallest step of the elements around each node.
std::vector<double> steps_at_nodes(const Model& model, const std::vector<double>& steps) {
  std::vector<double> least(model.assembly.nodes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t e = 0; e < steps.size(); ++e)
    for (int n : model.assembly.elements[e]) least[n] = std::fmin(least[n], steps[e]);
  return least;
}

/// How far a contact spring k shortens the stable step `step` of the elements under a surface node of mass m. Two rows of
/// elements (axial stiffness k_e, inner masses 2 m, end masses m) joined at their ends by a spring k have as highest
/// frequency that of a mode which dies out away from the contact: omega^2 = (1 + sqrt(1 + 4 beta^2)) k_e / m with
/// beta = k / k_e, against 2 k_e / m = 4 / step^2 of the rows alone. Corner and edge nodes have less mass, so larger beta.
double contact_step_at(double stiffness, double mass, double step) {
  const double beta = 0.5 * stiffness * step * step / mass;
  return step * std::sqrt(2 / (1 + std::sqrt(1 + 4 * beta * beta)));
}

double contact_step(const Model& model, const ContactPair& pair, const std::vector<double>& node_steps) {
  double stiffest = 0;
  for (double k : pair.segment_stiffness) stiffest = std::fmax(stiffest, k);
  double least = std::numeric_limits<double>::infinity();
  for (int n : pair.slave_nodes) least = std::fmin(least, contact_step_at(stiffest, model.mass[n], node_steps[n]));

  // On a finer slave surface several springs press on each master node.
  const auto area = [&](const std::array<int, 4>& facet, const std::vector<int>& nodes) {
    const auto x = [&](int k) { return model.assembly.nodes[nodes[facet[k]]]; };
    return facet_area(x(0), x(1), x(2), x(3));
  };
  double slave_area = std::numeric_limits<double>::infinity();
  for (const auto& facet : pair.slave_facets) slave_area = std::fmin(slave_area, area(facet, pair.slave_nodes));
  for (std::size_t s = 0; s < pair.master_segments.size(); ++s) {
    const double springs = std::fmax(1.0, area(pair.master_segments[s], pair.master_nodes) / slave_area);
    for (int m : pair.master_segments[s]) {
      const int n = pair.master_nodes[m];
      least = std::fmin(least, contact_step_at(springs * pair.segment_stiffness[s], model.mass[n], node_steps[n]));
    }
  }
  return least;
}

/// Mass of a connector's end, infinite for the ground. The end's nodes move together only in the mean, but the lightest
/// pattern that stretches the connector is theirs alone, so the elements beyond are not counted.
double end_mass(const Model& model, const std::string& end) {
  if (end == "ground") return std::numeric_limits<double>::infinity();
  double mass = 0;
  for (int n : model.assembly.node_sets.at(end)) mass += model.mass[n];
  return mass;
}

/// 2/step of the connectors alone, 1/s. Springs k and dashpots c on the reduced masses m of their ends make omega^2 = k/m
/// and omega zeta = c/2m, and a stable step 2/omega (sqrt(1 + zeta^2) - zeta); connectors that share an end add up.
double connector_frequency(const Model& model) {
  struct Sum {
    double squared = 0, half_rate = 0;
  };
  std::map<std::string, Sum> at_end;
  for (const scene::Connector& connector : model.scene.connectors) {
    const double inverse = 1 / end_mass(model, connector.from) + 1 / end_mass(model, connector.to);
    for (const std::string& end : {connector.from, connector.to}) {
      Sum& sum = at_end[end];
      sum.squared += inverse * *std::max_element(connector.stiffness.begin(), connector.stiffness.end());
      sum.half_rate += 0.5 * inverse * *std::max_element(connector.damping.begin(), connector.damping.end());
    }
  }
  double largest = 0;
  for (const auto& [end, sum] : at_end)
    if (end != "ground")
      largest = std::fmax(largest, std::sqrt(sum.squared + sum.half_rate * sum.half_rate) + sum.half_rate);
  return largest;
}

}  // namespace

void build_stable_step(Model& model) {
  StableStep& stable = model.stable_step;
  const auto steps = element_steps(model);
  stable.elements = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < steps.size(); ++e)
    if (steps[e] < stable.elements) {
      stable.elements = steps[e];
      stable.element = static_cast<int>(e);
    }
  double limit = stable.elements;
  if (!model.contacts.empty()) {
    const auto node_steps = steps_at_nodes(model, steps);
    stable.contact = std::numeric_limits<double>::infinity();
    for (const ContactPair& pair : model.contacts)
      stable.contact = std::fmin(stable.contact, contact_step(model, pair, node_steps));
    limit = std::fmin(limit, stable.contact);
  }
  if (!model.scene.connectors.empty()) {
    const double frequency = connector_frequency(model);
    stable.connector = frequency > 0 ? 2 / frequency : std::numeric_limits<double>::infinity();
    // The highest frequency of a sum is at most the root of the sum of squares.
    limit = 2 / std::sqrt(4 / (limit * limit) + frequency * frequency);
  }
  const scene::Time& time = model.scene.time;
  stable.used = time.step > 0 ? time.step : time.step_scale * limit;
  if (time.step > limit)
    throw InputError(fmt::format("{}: [time] step = {:.4g} s is longer than the stable step {:.4g} s of this mesh and its contacts; "
                                 "leave it out to have the program choose",
                                 model.scene.path, time.step, limit));
  // Whole steps, so that the run ends at the time asked for.
  model.step_count = static_cast<long>(std::ceil(time.end / stable.used - 1e-9));
  if (model.step_count < 1) model.step_count = 1;
  model.step_size = time.end / static_cast<double>(model.step_count);
}

}  // namespace railwave
