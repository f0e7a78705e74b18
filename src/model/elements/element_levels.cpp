#include <algorithm>
#include <cmath>
#include <set>

#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/build_steps.hpp"
#include "model/model.hpp"
#include "model/subcycling.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

/// Waves that margin_of_levels keeps from growing die out in elements that are fit for the coarser level but keep the
/// finer one's step: by e^-2 or more in each layer, by e^-4 in elements with so much larger a step than the coarser
/// level's.
constexpr int buffer = 2;
constexpr double deadens_at_once = 2.4;
/// Less is not worth smaller launches.
constexpr double least_gain = 1.1;

/// Each once: the connectors' step counts all of them together.
std::set<int> pulled_nodes(const std::vector<ConnectorCell>& cells) {
  std::set<int> nodes;
  for (const ConnectorCell& cell : cells)
    for (const WeightedNodes* end : {&cell.from, &cell.to}) nodes.insert(end->nodes.begin(), end->nodes.end());
  return nodes;
}

/// By element, what its own stable step would be. Heights can be beyond what a region one or two elements thick allows,
/// and only the finest level is asked whether they are.
class OwnSteps {
 public:
  /// @param connector s, stable step of the connectors alone; 0: none
  OwnSteps(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
           const std::vector<ConnectorCell>& cells, double connector)
      : assembled_(assembled), at_node_(assembled.assembly.nodes.size(), 0) {
    for (const ContactPair& pair : contacts)
      if (pair.has_springs()) add_contact(pair);
    if (connector > 0 && std::isfinite(connector))
      for (int n : pulled_nodes(cells)) at_node_[n] += 4 / (connector * connector);
  }

  /// The square of a sum's highest frequency is at most the sum of the squares.
  /// @param steps s, of the elements without springs
  std::vector<double> with_springs(std::vector<double> steps) const {
    for (std::size_t e = 0; e < steps.size(); ++e) {
      double springs = 0;
      for (int n : assembled_.assembly.elements[e]) springs = std::fmax(springs, at_node_[n]);
      steps[e] = 2 / std::sqrt(4 / (steps[e] * steps[e]) + springs);
    }
    return steps;
  }

 private:
  /// A spring k between two nodes of mass m: omega^2 = 2 k / m.
  void add_contact(const ContactPair& pair) {
    double stiffest = 0;
    for (double k : pair.segment_stiffness) stiffest = std::fmax(stiffest, pair.growth * k);
    for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *nodes) at_node_[n] += 2 * stiffest / assembled_.mass[n];
  }

  const AssembledScene& assembled_;
  std::vector<double> at_node_;  ///< squared frequency of springs, 1/s2
};

/// With one of the nodes that are marked.
std::vector<int> elements_at(const Assembly& assembly, const std::vector<char>& marked) {
  std::vector<int> elements;
  for (std::size_t e = 0; e < assembly.elements.size(); ++e) {
    const auto& nodes = assembly.elements[e];
    if (std::any_of(nodes.begin(), nodes.end(), [&](int n) { return marked[n] != 0; }))
      elements.push_back(static_cast<int>(e));
  }
  return elements;
}

/// Bodies in contact are neighbours wherever they may touch: one level for the elements of both surfaces.
void level_contacts(const Assembly& assembly, const std::vector<ContactPair>& contacts, std::vector<int>& fit) {
  for (const ContactPair& pair : contacts) {
    std::vector<char> of_pair(assembly.nodes.size(), 0);
    for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *nodes) of_pair[n] = 1;
    const std::vector<int> elements = elements_at(assembly, of_pair);
    int least = most_levels;
    for (int e : elements) least = std::min(least, fit[e]);
    for (int e : elements) fit[e] = least;
  }
}

/// What asks for all forces on its nodes at every step, or moves them itself, has elements of the finest level alone:
/// multipliers, which look one step ahead; ties, which pass forces on; prescribed motions; and beams, whose stiffness
/// no element's own step knows.
std::vector<char> nodes_of_every_step(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                                      const Ties& ties) {
  const Assembly& assembly = assembled.assembly;
  std::vector<char> of_every_step(assembly.nodes.size(), 0);
  const auto mark = [&](const std::vector<int>& nodes) {
    for (int n : nodes) of_every_step[n] = 1;
  };
  for (const ContactPair& pair : contacts) {
    if (pair.has_springs()) continue;
    mark(pair.slave_nodes);
    mark(pair.master_nodes);
  }
  mark(ties.masters);
  for (const TiedPlace& tied : ties.places) of_every_step[tied.slave] = 1;
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions)
    mark(find_node_set(assembled.scene, assembly, motion, "target", motion.target));
  for (const Assembly::BeamChain& chain : assembly.beam_chains) mark(chain.nodes);
  return of_every_step;
}

/// Takes the buffer's layers from the elements `in` a level: those nearer than `buffer` to what is not in it.
void take_buffer(const Assembly& assembly, const std::vector<double>& steps, double level_step, std::vector<char>& in) {
  std::vector<int> distance(assembly.nodes.size(), buffer);
  const auto nearest = [&](std::size_t e) {
    int least = buffer;
    for (int n : assembly.elements[e]) least = std::min(least, distance[n]);
    return least;
  };
  for (std::size_t e = 0; e < in.size(); ++e)
    if (in[e] == 0)
      for (int n : assembly.elements[e]) distance[n] = 0;
  for (int layer = 0; layer < buffer; ++layer)
    for (std::size_t e = 0; e < in.size(); ++e) {
      if (in[e] == 0 || nearest(e) != layer) continue;
      const int beyond = layer + (steps[e] >= deadens_at_once * level_step ? buffer : 1);
      for (int n : assembly.elements[e]) distance[n] = std::min(distance[n], beyond);
    }
  for (std::size_t e = 0; e < in.size(); ++e)
    if (nearest(e) < buffer) in[e] = 0;
}

}  // namespace

std::vector<int> element_levels(const scene::Scene& scene, const Assembly& assembly) {
  // The parts of a model that stable steps depend on. Its elements are not in blocks yet.
  Model model;
  model.scene = scene;
  model.assembly = assembly;
  model.absorbing = absorbing_layers(scene, assembly);
  build_bodies(model);
  model.connectors.cells = connector_cells(scene, assembly, model.mass);
  build_stable_step(model);
  plan_steps(scene, 1, model);

  const OwnSteps own(model, model.contacts, model.connectors.cells, model.stable_step.connector);
  auto steps = own.with_springs(safe_steps(model, model.absorbing));
  if (steps.empty()) return {};
  const double finest = *std::min_element(steps.begin(), steps.end());
  const double scale = scene.time.step > 0 ? std::min(1.0, model.step_size / finest) : scene.time.step_scale;
  std::vector<int> fit(steps.size());
  for (std::size_t e = 0; e < steps.size(); ++e) {
    steps[e] *= scale;
    fit[e] = std::clamp(static_cast<int>(std::floor(std::log2(steps[e] / (margin_of_levels * model.step_size)))), 0,
                        most_levels - 1);
  }
  level_contacts(assembly, model.contacts, fit);
  for (int e : elements_at(assembly, nodes_of_every_step(model, model.contacts, model.ties))) fit[e] = 0;

  std::vector<int> levels(steps.size(), 0);
  std::vector<char> in(steps.size(), 1);
  for (int l = 1; l < most_levels; ++l) {
    for (std::size_t e = 0; e < in.size(); ++e) in[e] = in[e] != 0 && fit[e] >= l ? 1 : 0;
    take_buffer(assembly, steps, static_cast<double>(1L << l) * model.step_size, in);
    for (std::size_t e = 0; e < in.size(); ++e)
      if (in[e] != 0) levels[e] = l;
  }
  double updates = 0;
  for (int level : levels) updates += 1.0 / static_cast<double>(1L << level);
  return static_cast<double>(levels.size()) < least_gain * updates ? std::vector<int>{} : levels;
}

}  // namespace railwave
