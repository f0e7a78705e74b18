#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/beams/beams.hpp"
#include "model/build_steps.hpp"
#include "model/contact/contact_springs.hpp"
#include "model/host_copy.hpp"
#include "model/model.hpp"
#include "model/ranks/mesh_share.hpp"
#include "model/time_step/automatic_step.hpp"
#include "model/time_step/estimate_share.hpp"
#include "model/time_step/global_step.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

/// Share of the stable step that is never passed: right on it the highest mode grows, if slowly, and estimates round.
constexpr double below_the_limit = 0.995;
/// Share of the stable step that is taken where contact springs shorten it and bodies strike undamped. Closed for good
/// the springs are stable up to the limit; but near it nodes that touch and part again and again gain energy: struck
/// bars of matching meshes 12 % at 0.9 of the limit, below 1 % at 0.81 (docs/hourglass.md).
constexpr double springs_that_open = 0.9;

/// Stable step of an element of the undamped stable step dt_0 whose part is damped. With velocities half a step behind,
/// dt^2/4 K + dt/2 C <= M; C = beta K + alpha M makes of it dt^2 + 2 b dt <= dt_0^2, b = beta + alpha dt_0^2 / 4. Bulk
/// viscosity acts on changes of volume alone, which have at least the bulk modulus k: it counts as beta =
/// (Q2 c + Q1 v) l rho / k, with l |tr d| at most v, the speed of what hits.
/// @param length V^(1/3), m
double damped_element_step(const scene::Part& part, const scene::Material& material, double length, double speed,
                           double step) {
  if (!part.damped()) return step;
  const double viscous =
      (part.linear_bulk_viscosity * material.dilatational_speed() + part.quadratic_bulk_viscosity * speed) * length *
      material.density / material.bulk_modulus();
  const double b = part.stiffness_damping + viscous + 0.25 * part.mass_damping * step * step;
  return step * step / (std::sqrt(step * step + b * b) + b);
}

/// The same of a mass damping alone: b = alpha dt_0^2 / 4.
double dragged_element_step(double rate, double step) {
  const double b = 0.25 * rate * step * step;
  return step * step / (std::sqrt(step * step + b * b) + b);
}

/// Shortens an element's step by absorbing layers, in whose elements the fastest decay counts everywhere.
void drag(const Assembly& assembly, const AbsorbingLayers& absorbing, int element, double& step) {
  const auto& rate = absorbing.rate;
  if (rate.empty()) return;
  double most = 0;
  for (int n : assembly.elements[element]) most = std::fmax(most, rate[n]);
  if (most > 0) step = dragged_element_step(most, step);
}

/// Stable steps of elements by their highest eigenvalues.
struct EigenvalueSteps {
  std::vector<double> step, control;

  explicit EigenvalueSteps(std::size_t count) : step(count), control(count) {}
};

/// @param elements whose steps are wanted; null: all
EigenvalueSteps eigenvalue_steps(const AssembledScene& assembled, const AbsorbingLayers& absorbing,
                                 const std::vector<int>* elements = nullptr) {
  const Assembly& assembly = assembled.assembly;
  EigenvalueSteps steps(elements != nullptr ? elements->size() : assembly.elements.size());
  const double speed = largest_initial_speed(assembled.scene);
  on_host_threads(static_cast<int>(steps.step.size()), [&](int i) {
    const int e = elements != nullptr ? (*elements)[i] : i;
    const int p = part_of_element(assembly, e);
    const scene::Part& part = assembled.scene.parts[p];
    const scene::Material& material = assembled.scene.materials[assembly.parts[p].material];
    const HexahedronCorners corners = corners_of(assembly.nodes, assembly.elements[e]);
    const ElementStep own = element_eigenvalue_step(corners, material, part.hourglass, part.hourglass_coefficient);
    steps.step[i] = own.step;
    steps.control[i] = own.control;
    if (part.damped())
      steps.step[i] = damped_element_step(part, material, std::cbrt(hexahedron_volume(corners)), speed, steps.step[i]);
    drag(assembly, absorbing, e, steps.step[i]);
  });
  return steps;
}

/// Each rank computes those of its blocks. Rank 0 gets those of all elements, another rank its own, ascending.
EigenvalueSteps eigenvalue_steps_of_ranks(const Model& model, Transport& transport) {
  const std::vector<int> own = elements_of_rank(model, transport.rank());
  EigenvalueSteps steps = eigenvalue_steps(model, model.absorbing, &own);
  meet(transport);
  if (transport.rank() > 0) {
    for (const auto* values : {&steps.step, &steps.control})
      transport.start_send(0, values->data(), sizeof(double) * values->size());
    transport.finish();
    return steps;
  }
  EigenvalueSteps all(model.element_count());
  const auto put = [&all](const std::vector<int>& elements, const EigenvalueSteps& of) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      all.step[elements[i]] = of.step[i];
      all.control[elements[i]] = of.control[i];
    }
  };
  put(own, steps);
  for (int r = 1; r < transport.ranks(); ++r) {
    const std::vector<int> others = elements_of_rank(model, r);
    steps = EigenvalueSteps(others.size());
    for (auto* values : {&steps.step, &steps.control})
      transport.start_receive(r, values->data(), sizeof(double) * values->size());
    transport.finish();
    put(others, steps);
  }
  return all;
}

/// Stable step of each element, V / (A_max C_d), which knows of waves only, and no more than its hourglass control
/// allows: a viscous one of more than about 0.13 would else go unstable.
std::vector<double> element_steps(const AssembledScene& assembled, const AbsorbingLayers& absorbing,
                                  const EigenvalueSteps& eigenvalues) {
  std::vector<double> steps(assembled.element_length.size());
  for (std::size_t p = 0; p < assembled.assembly.parts.size(); ++p) {
    const auto& part = assembled.assembly.parts[p];
    const double speed = assembled.scene.materials[part.material].dilatational_speed();
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e)
      // Heights can be somewhat too long, which stiff damping makes worse: damped elements go by their eigenvalues.
      steps[e] = assembled.scene.parts[p].damped()
                     ? eigenvalues.step[e]
                     : std::fmin(assembled.element_length[e] / speed, eigenvalues.control[e]);
  }
  for (std::size_t e = 0; e < steps.size(); ++e) drag(assembled.assembly, absorbing, static_cast<int>(e), steps[e]);
  return steps;
}

/// Smallest step of the elements around each node.
std::vector<double> steps_at_nodes(const Assembly& assembly, const std::vector<double>& steps) {
  std::vector<double> least(assembly.nodes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t e = 0; e < steps.size(); ++e)
    for (int n : assembly.elements[e]) least[n] = std::fmin(least[n], steps[e]);
  return least;
}

/// How far a contact spring k shortens the stable step `step` of the elements under a surface node of mass m. Two rows
/// of elements (axial stiffness k_e, inner masses 2 m, end masses m) joined at their ends by a spring k have as highest
/// frequency that of a mode which dies out away from the contact: omega^2 = (1 + sqrt(1 + 4 beta^2)) k_e / m with
/// beta = k / k_e, against 2 k_e / m = 4 / step^2 of the rows alone. Corner and edge nodes have less mass, so larger
/// beta.
double contact_step_at(double stiffness, double mass, double step) {
  const double beta = 0.5 * stiffness * step * step / mass;
  return step * std::sqrt(2 / (1 + std::sqrt(1 + 4 * beta * beta)));
}

/// The same of springs k on elements that may be alone under the surface. Each side of the contact is as if it had a
/// spring 2 k to the ground: b = dt^2/4 2 k / m. A surface's motion has at most half its energy in strains, whose modes
/// have a <= dt^2/4 omega^2, and can have all of it in hourglass modes, whose control has c (linear in dt where
/// viscous, at most so where stiff). Together they are stable while b times the largest of p/(1 - a) + q/(1 - c) + (1 -
/// p - q) is at most 1.
double contact_step_on_eigenvalues(double stiffness, double mass, double step, double control_step) {
  double low = 0, high = std::fmin(step, control_step);
  for (int i = 0; i < 40; ++i) {
    const double dt = 0.5 * (low + high);
    const double strain = 1 / (1 - dt * dt / (step * step)), hourglass = 1 / (1 - dt / control_step);
    const double b = 0.5 * dt * dt * stiffness / mass;
    (b * std::fmax(hourglass, 0.5 * (strain + hourglass)) <= 1 ? low : high) = dt;
  }
  return low;
}

/// Springs k with dashpots c on the velocity half a step back: of a step dt the dashpots are worth 2 c / dt of
/// stiffness.
/// @param step_at stable step with springs of a stiffness, the shorter the stiffer
template <class StepAt>
double damped_step(double stiffness, double damping, const StepAt& step_at) {
  double step = step_at(stiffness);
  if (!(damping > 0)) return step;
  // From above, and each step shorter: a shorter step makes the dashpots stiffer.
  for (int i = 0; i < 200; ++i) {
    const double next = step_at(stiffness + 2 * damping / step);
    if (next > (1 - 1e-9) * step) break;
    step = next;
  }
  return step;
}

/// @param step_at stable step of springs of a stiffness on a node
template <class StepAt>
double contacts_step(const ContactOnNodes& contact, const StepAt& step_at) {
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < static_cast<int>(contact.stiffness.size()); ++n)
    if (contact.stiffness[n] > 0)
      least = std::fmin(least,
                        damped_step(contact.stiffness[n], contact.damping[n], [&](double k) { return step_at(k, n); }));
  return least;
}

/// Position of the smallest of the steps, and the step; -1 and infinity: none.
std::pair<int, double> least_of(const std::vector<double>& steps) {
  const auto least = std::min_element(steps.begin(), steps.end());
  if (least == steps.end()) return {-1, std::numeric_limits<double>::infinity()};
  return {static_cast<int>(least - steps.begin()), *least};
}

/// Step of two systems together: the square of the sum's highest frequency is at most the sum of the squares.
double together(double step, double frequency) { return 2 / std::sqrt(4 / (step * step) + frequency * frequency); }

/// The estimate of the assembled scene.
std::shared_ptr<GlobalEstimate> global_estimate_of(const Model& model) {
  return std::make_shared<GlobalEstimate>(model, model, model.connectors.cells, model.contacts, model.ties,
                                          model.absorbing);
}

/// What rank 0 has the others do before steps are taken: search the highest frequency of the elements, or not.
struct SearchOrder {
  int shared = 0;
  double longest = 0;  ///< s
};

/// Rank 0's order, once in making a model, whatever comes of it.
class SearchLeader {
 public:
  explicit SearchLeader(Transport* transport) : transport_(transport) {}
  ~SearchLeader() {
    try {
      order({});
    } catch (const std::exception&) {
      // The others find out at their next meeting.
    }
  }
  SearchLeader(const SearchLeader&) = delete;
  SearchLeader& operator=(const SearchLeader&) = delete;

  /// Null where each process searches for itself.
  Transport* transport() const { return transport_; }
  void order(SearchOrder one) {
    if (transport_ != nullptr && !given_) transport_->broadcast(&one, sizeof one);
    given_ = true;
  }

 private:
  Transport* transport_;
  bool given_ = false;
};

/// Springs of contacts; empty where there are none.
ContactOnNodes springs_of_contacts(const Model& model) {
  return has_contact_springs(model.contacts) ? contact_on_nodes(model, model.contacts) : ContactOnNodes{};
}

/// Of all ranks together: each calls it.
double search_together(Model& model, const ContactOnNodes& springs, double longest, Transport& transport) {
  EstimateShare share(model, model, transport);
  // Rank 0 is asked for the whole mesh until a run begins.
  if (transport.rank() > 0) keep_mesh_of_blocks(model, transport.rank());
  const ContactOnNodes contact = share.own_part(springs);
  const Ties no_ties;
  const std::vector<ConnectorCell> no_cells;
  GlobalEstimate estimate(share.assembled(), share.nodal(), no_cells, model.contacts, no_ties, model.absorbing);
  estimate.set_share(&share);
  share.forget_mesh();
  meet(transport);
  return estimate.of_elements(contact, longest).step;
}

/// What heights promise is the limit of waves inside a body: free surfaces, edges and corners, bodies few elements
/// thick, and contact on top of that go below it. Where the eigenvalues do not vouch for a step, the scene's own
/// highest frequency is asked. A model without nodes (of which levels are counted) can't be.
double stable_together(Model& model, double by_elements, double by_eigenvalues, SearchLeader& leader) {
  if (by_eigenvalues >= by_elements || model.nodes.count == 0) return by_elements;
  double step = 0;
  if (leader.transport() != nullptr && EstimateShare::possible(model.scene)) {
    leader.order({1, by_elements});
    step = search_together(model, springs_of_contacts(model), by_elements, *leader.transport());
  } else {
    step = global_estimate_of(model)->of_elements(springs_of_contacts(model), by_elements).step;
  }
  return std::fmax(by_eigenvalues, step);
}

void estimate_by_elements(Model& model, EigenvalueSteps eigenvalues, SearchLeader& leader) {
  StableStep& stable = model.stable_step;
  auto heights = element_steps(model, model.absorbing, eigenvalues);
  model.own_steps.assign(eigenvalues.step.begin(), eigenvalues.step.end());
  std::tie(stable.element, stable.elements) = least_of(heights);
  std::tie(stable.eigenvalue_element, stable.eigenvalue) = least_of(eigenvalues.step);
  const auto place = [&](int element) {
    return element < 0 ? Vec3{} : model.assembly.nodes[model.assembly.elements[element][0]];
  };
  stable.element_place = place(stable.element);
  stable.eigenvalue_place = place(stable.eigenvalue_element);
  stable.by_elements = stable.elements;
  stable.by_eigenvalues = stable.eigenvalue;
  // Multipliers are constraints: they add no frequency above the elements' own.
  if (has_contact_springs(model.contacts)) {
    const auto at_node = steps_at_nodes(model.assembly, heights);
    const ContactOnNodes contact = contact_on_nodes(model, model.contacts);
    stable.contact =
        contacts_step(contact, [&](double k, int n) { return contact_step_at(k, model.mass[n], at_node[n]); });
    const auto step = steps_at_nodes(model.assembly, eigenvalues.step),
               control = steps_at_nodes(model.assembly, eigenvalues.control);
    stable.eigenvalue_contact = contacts_step(
        contact, [&](double k, int n) { return contact_step_on_eigenvalues(k, model.mass[n], step[n], control[n]); });
    stable.by_elements = std::fmin(stable.by_elements, stable.contact);
    stable.by_eigenvalues = std::fmin(stable.by_eigenvalues, stable.eigenvalue_contact);
  }
  eigenvalues = EigenvalueSteps(0);
  heights = std::vector<double>();
  stable.by_elements = stable_together(model, stable.by_elements, stable.by_eigenvalues, leader);
  const bool strikes = strikes_undamped(model.scene, model.contacts);
  if (strikes && stable.contact > 0 && stable.contact < stable.elements) stable.by_elements *= springs_that_open;
  if (strikes && stable.eigenvalue_contact > 0 && stable.eigenvalue_contact < stable.eigenvalue)
    stable.by_eigenvalues *= springs_that_open;
  // Beams' elements have masses of their own like those of solids, so that the highest frequency of any is an upper
  // bound.
  if (model.beams) {
    stable.beam = model.beams->step;
    stable.by_elements = std::fmin(stable.by_elements, stable.beam);
    stable.by_eigenvalues = std::fmin(stable.by_eigenvalues, stable.beam);
  }
  if (!model.scene.connectors.empty()) {
    const double frequency = connector_frequency(model.scene, model.connectors.cells, model.mass);
    stable.connector = frequency > 0 ? 2 / frequency : std::numeric_limits<double>::infinity();
    stable.by_elements = together(stable.by_elements, frequency);
    stable.by_eigenvalues = together(stable.by_eigenvalues, frequency);
  }
}

}  // namespace

std::vector<double> own_steps(const AssembledScene& assembled, const AbsorbingLayers& absorbing) {
  const EigenvalueSteps eigenvalues = eigenvalue_steps(assembled, absorbing);
  return assembled.scene.solver.step_estimate == scene::StepEstimate::eigenvalue
             ? eigenvalues.step
             : element_steps(assembled, absorbing, eigenvalues);
}

std::vector<double> safe_steps(const AssembledScene& assembled, const AbsorbingLayers& absorbing) {
  return eigenvalue_steps(assembled, absorbing).step;
}

bool strikes_undamped(const scene::Scene& scene, const std::vector<ContactPair>& contacts) {
  if (scene.settle.active) return false;
  const bool viscous = std::all_of(scene.parts.begin(), scene.parts.end(), [](const scene::Part& part) {
    return part.hourglass == scene::HourglassType::viscous && part.hourglass_coefficient > 0;
  });
  return !viscous && std::any_of(contacts.begin(), contacts.end(), [](const ContactPair& pair) {
    return pair.has_springs() && !(pair.contact->damping > 0);
  });
}

double largest_initial_speed(const scene::Scene& scene) {
  double largest = 0;
  for (const scene::InitialMotion& motion : scene.initial_motions)
    largest = std::fmax(largest, length(motion.velocity));
  return largest;
}

double largest_step(const scene::Time& time, const StableStep& stable) {
  // A step that the case gives has no scale; where elements go on changing their shape it keeps a distance.
  const double largest = (time.step > 0 && stable.deformed > 0 ? 0.9 : below_the_limit) * stable.limit;
  return std::fmin(largest, time.step > 0 ? time.step : time.step_scale * stable.limit);
}

void renew_global_step(const scene::Scene& scene, const std::vector<ContactPair>& contacts, double time,
                       StepSizes& sizes) {
  StableStep& stable = sizes.stable_step;
  const int renew_steps = scene.solver.renew_steps;
  const double left = scene.time.end - time;
  const double horizon = renew_steps > 0 ? std::fmin(left, renew_steps * stable.by_elements) : left;
  // A scene of point masses on dashpots alone has no elements to begin from.
  const double first_guess = std::isfinite(stable.by_elements) ? stable.by_elements : scene.time.end;
  GlobalStep found = (*sizes.global_estimate)({horizon}, stable.global > 0 ? 0.99 * stable.global : first_guess);
  // It knows beams by their mass only.
  if (stable.beam > 0) found.step = together(found.step, 2 / stable.beam);
  stable.global = stable.limit = found.step;
  // Springs that the scene's highest mode hardly feels open in other modes all the same.
  if (found.springs > 0 && stable.contact < stable.elements && strikes_undamped(scene, contacts))
    stable.limit *= springs_that_open;
  stable.springs = found.springs;
  stable.seen = std::move(found.seen);
}

void help_with_stable_step(Model& model, Transport& transport) {
  {
    const EigenvalueSteps own = eigenvalue_steps_of_ranks(model, transport);
    model.own_steps.assign(own.step.begin(), own.step.end());
  }
  const ContactOnNodes springs = springs_of_contacts(model);
  // Rank 0 alone asks for them from here on.
  model.mass = std::vector<double>();
  model.element_length = std::vector<double>();
  SearchOrder order;
  transport.broadcast(&order, sizeof order);
  if (order.shared != 0) search_together(model, springs, order.longest, transport);
}

void build_stable_step(Model& model, Transport* transport) {
  StableStep& stable = model.stable_step;
  {
    EigenvalueSteps eigenvalues =
        transport != nullptr ? eigenvalue_steps_of_ranks(model, *transport) : eigenvalue_steps(model, model.absorbing);
    SearchLeader leader(transport);
    estimate_by_elements(model, std::move(eigenvalues), leader);
  }
  const scene::StepEstimate choice = model.scene.solver.step_estimate;
  stable.limit = choice == scene::StepEstimate::eigenvalue ? stable.by_eigenvalues : stable.by_elements;
  if (choice == scene::StepEstimate::global) {
    model.global_estimate = global_estimate_of(model);
    renew_global_step(model.scene, model.contacts, model.time, model);
  } else if (choice == scene::StepEstimate::automatic) {
    choose_step(model);
  }
  const scene::Time& time = model.scene.time;
  if (time.step > stable.limit)
    throw InputError(
        fmt::format("{}: [time] step = {:.4g} s is longer than the stable step {:.4g} s of this mesh and its contacts; "
                    "leave it out to have the program choose{}",
                    model.scene.path, time.step, stable.limit,
                    choice == scene::StepEstimate::global || stable.choice.reason == StepChoice::Reason::gains_little
                        ? ""
                        : ", or see whether [solver] step_estimate = \"global\" allows more"));
  // Nobody waits for so many; far below where they can't be counted.
  constexpr double most_steps = 1e15;
  const double largest = largest_step(time, stable);
  if (const double steps = time.end / largest; !(steps <= most_steps))
    throw InputError(
        fmt::format("{}: [time] end = {:.4g} s takes {:.3g} steps of {:.3g} s, at most {:.0g} are run; the step is set "
                    "by {}, times time.step_scale = {:.3g}: mend that, or end it earlier{}",
                    model.scene.path, time.end, steps, largest, most_steps, what_sets_step(model, stable),
                    time.step_scale, time.step > 0 ? ", or give a longer step" : ""));
}

}  // namespace railwave
