#include "solve/statics/settle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "case/error.hpp"
#include "kernels/statics/relaxation.hpp"
#include "kernels/support/reductions.hpp"
#include "mesh/hexahedron.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/ties.hpp"
#include "model/host_copy.hpp"
#include "solve/plan.hpp"
#include "solve/tasks/beam_forces.hpp"

namespace railwave {
namespace {

/// Share of the unbalanced force that damps. Little: what local vibrations lose to it also brakes the bodies' slow
/// approach, which the resets at peaks of kinetic energy end.
constexpr double local_damping = 0.05;
constexpr int steps_between_peaks = 10;
/// Share of each element's stable step V / (A_max C_d) that one unit of pseudo-time stands for. A lone element is
/// stable up to 0.73 of it; force against velocity counts 1 + local_damping.
constexpr double safety = 0.65;
constexpr int steps_between_checks = 50;

/// Masses with which a unit step is stable everywhere: an element's mass over its own stable step squared, and for
/// springs the bound m >= sum_j |K_ij| / 4 of the central difference.
std::vector<double> relaxation_masses(const Model& model) {
  const Assembly& assembly = model.assembly;
  std::vector<double> mass(assembly.nodes.size(), 0);
  for (const auto& part : assembly.parts) {
    const double modulus = model.scene.materials[part.material].dilatational_modulus();
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e) {
      const auto integrals = hexahedron_shape_integrals(corners_of(assembly.nodes, assembly.elements[e]));
      const double length = safety * model.element_length[e];
      for (int N = 0; N < 8; ++N) mass[assembly.elements[e][N]] += integrals[N] * modulus / (length * length);
    }
  }
  const double spring_share = 0.5 / (safety * safety);
  for (const ContactPair& pair : model.contacts) {
    if (!pair.has_springs()) continue;
    double stiffest = 0;
    for (double k : pair.segment_stiffness) stiffest = std::max(stiffest, pair.growth * k);
    for (int n : pair.slave_nodes) mass[n] += spring_share * stiffest;
    // Several slave nodes can press on one master node where the slave is the finer one.
    const double slaves_of_master =
        std::max(1.0, static_cast<double>(pair.slave_nodes.size()) / pair.master_nodes.size());
    for (int n : pair.master_nodes) mass[n] += spring_share * stiffest * slaves_of_master;
  }
  const auto& cell = model.connectors.cell;
  const auto& share = model.connectors.share;
  const auto contribution_node = to_host(model.external.contribution_node);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const ConnectorCell& own = model.connectors.cells[cell[i]];
    const Vec3& k = model.scene.connectors[own.connector].stiffness;
    mass[contribution_node(model.connectors.first + i)] +=
        spring_share * std::fabs(share[i]) * own.share * (k[0] + k[1] + k[2]);
  }
  if (model.beams)
    for (std::size_t n = 0; n < mass.size(); ++n) mass[n] += model.beams->relaxation_mass[n];
  for (int n : assembly.point_nodes)
    if (!model.beams || model.beams->number[n] < 0) mass[n] = 1e300;  // held
  mass = masses_with_ties(model.ties, std::move(mass));
  for (int n : model.ends.nodes) mass[n] = 1e300;
  return mass;
}

/// Twice the kinetic energy of the relaxation's masses.
struct RelaxationEnergy {
  static constexpr int values = 1;
  RelaxationUpdate update;
  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    const Vector3 v = row(update.acceleration.force.nodes.velocity, n);
    if (update.relaxation_mass(n) < 1e299) sum[0] += update.relaxation_mass(n) * dot(v, v);
  }
};

struct Unbalance {
  static constexpr int values = 2;
  RelaxationUpdate update;
  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    const NodeArrays& nodes = update.acceleration.force.nodes;
    if (update.relaxation_mass(n) > 1e299) return;  // held
    sum[0] += norm(row(update.unbalanced, n));
    Vector3 applied = nodes.mass(n) * (update.acceleration.gravity + row(update.body_acceleration, n));
    sum[1] += norm(applied);
    sum[1] += norm(update.acceleration.force.external_force(n));
  }
};

/// Forces and motion in pseudo-time. The update must outlive the plan.
Plan relaxation_plan(Model& model, const RelaxationUpdate& update) {
  constexpr StepKind kind = StepKind::settling;
  Plan plan{force_tasks(model, kind, &update), {}};
  plan.motion.push_back({"relaxation of nodes", "f to j", [&model, &update](const Instant&) {
                           Kokkos::parallel_for("relaxation_update", Range(0, model.nodes.count), update);
                         }});
  if (model.ties.arrays.active()) plan.motion.push_back(tied_nodes_task(model, model.ties, kind));
  if (model.beams)
    plan.motion.push_back({"relaxation of beams' rotations", "f to j",
                           [&model](const Instant&) { relax_rotations(*model.beams, local_damping); }});
  return plan;
}

SettleReport settle_by_relaxation(Model& model, int most_steps, const std::function<bool(const SettleReport&)>& go_on) {
  SettleReport report;
  const RelaxationUpdate update{
      model.acceleration(), to_device("relaxation mass", relaxation_masses(model)),
      to_device("centrifugal field", centrifugal_field(model, model.nodes.reference, model.beams)),
      Array<double* [3]>("unbalanced", model.nodes.count), local_damping};
  const Plan plan = relaxation_plan(model, update);
  Instant instant;
  instant.step = 1;
  const scene::Settle& wish = model.scene.settle;
  double energy_before = 0;
  AppliedForces applied(model);
  for (report.steps = 0; report.steps < most_steps; ++report.steps) {
    model.step = report.steps;
    run_tasks(plan.forces, instant, model.step);
    run_tasks(plan.motion, instant, model.step);
    if (report.steps % steps_between_peaks == 0) {
      double energy = 0;
      block_sum(RelaxationEnergy{update}, model.nodes.count, &energy, *model.reduction_space);
      if (model.beams) energy += relaxation_state(*model.beams, *model.reduction_space).energy;
      if (energy < energy_before) {
        Kokkos::deep_copy(model.nodes.velocity, 0.0);
        if (model.beams) stop_rotations(*model.beams);
        energy = 0;
      }
      energy_before = energy;
    }
    if (report.steps % steps_between_checks != 0 || report.steps == 0) continue;
    double sum[2];
    block_sum(Unbalance{update}, model.nodes.count, sum, *model.reduction_space);
    if (model.beams) {
      const BeamRelaxationState beams = relaxation_state(*model.beams, *model.reduction_space);
      sum[0] += beams.unbalanced;
      sum[1] += beams.applied;
    }
    sum[1] = applied(sum[1]);
    report.unbalance = sum[1] > 0 ? sum[0] / sum[1] : sum[0];
    report.settled = report.unbalance < wish.tolerance;
    if (report.settled || !std::isfinite(report.unbalance) || !go_on(report)) break;
  }
  hold_ends(model.ends, model.nodes.position, update.unbalanced);
  tighten_beams(model.beams, model.nodes, false);
  return report;
}

/// Newton's method; where that finds no equilibrium, relaxation from where both began.
SettleReport settle_automatically(Model& model, const std::function<bool(const SettleReport&)>& go_on,
                                  Transport* others) {
  const StaticState start = save_static_state(model);
  SettleReport newton;
  bool stopped = false;
  try {
    const auto go_on_still = [&](const SettleReport& so_far) {
      newton.steps = so_far.steps;
      stopped = stopped || !go_on(so_far);
      return !stopped;
    };
    newton = settle_by_newton(model, go_on_still, others);
    if (newton.settled || stopped) return newton;
  } catch (const InputError& error) {
    newton.adrift = error.what();
  }
  restore_static_state(model, start);
  SettleReport report = settle_by_relaxation(model, model.scene.settle.max_steps - newton.steps, go_on);
  report.steps += newton.steps;
  if (!report.settled) report.adrift = newton.adrift;
  report.remarks.push_back(fmt::format(
      "Newton's method did not settle it in {} evaluations{}{}; then it was left to relaxation, which holds "
      "point masses where they are",
      newton.steps, newton.adrift.empty() ? "" : ": ", newton.adrift));
  return report;
}

SettleReport settle_by(scene::SettleMethod method, Model& model, const std::function<bool(const SettleReport&)>& go_on,
                       Transport* others) {
  switch (method) {
    case scene::SettleMethod::automatic:
      return settle_automatically(model, go_on, others);
    case scene::SettleMethod::newton:
      return settle_by_newton(model, go_on, others);
    case scene::SettleMethod::relaxation:
      break;
  }
  return settle_by_relaxation(model, model.scene.settle.max_steps, go_on);
}

}  // namespace

AppliedForces::AppliedForces(const Model& model) {
  const Assembly& assembly = model.assembly;
  double farthest = 0, stiffness = 0;
  for (const Vec3& x : assembly.nodes)
    for (const double along : x) farthest = std::max(farthest, std::fabs(along));
  for (const auto& part : assembly.parts)
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e)
      stiffness += model.scene.materials[part.material].dilatational_modulus() * model.element_length[e];
  constexpr double half_a_unit = 0.5 * std::numeric_limits<double>::epsilon();  // in the last place
  least_ = half_a_unit * farthest * stiffness / model.scene.settle.tolerance;
}

std::vector<Vec3> centrifugal_field(const AssembledScene& assembled, const Array<double* [3]>& reference,
                                    const std::shared_ptr<BeamModel>& beams) {
  std::vector<Vec3> field(assembled.assembly.nodes.size(), Vec3{0, 0, 0});
  // A point mass goes along with its body's velocity, but nothing leads it round.
  std::vector<int> points = assembled.assembly.point_nodes;
  std::sort(points.begin(), points.end());
  for (const scene::InitialMotion& motion : assembled.scene.initial_motions) {
    for (const std::string& name : motion.parts) {
      const Vec3 w = turned_with_part_of(assembled.scene, name, motion.angular_velocity);
      const Vec3 centre = rotation_centre(assembled, motion, name, reference);
      for (int n : assembled.assembly.node_sets.at(name)) {
        const bool beam_ends = beams && beams->number[n] >= 0;
        if (!beam_ends && std::binary_search(points.begin(), points.end(), n)) continue;
        Vec3 r{};
        double along = 0, squared = 0;
        for (int i = 0; i < 3; ++i) {
          r[i] = assembled.assembly.nodes[n][i] - centre[i];
          along += w[i] * r[i];
          squared += w[i] * w[i];
        }
        for (int i = 0; i < 3; ++i) field[n][i] += squared * r[i] - along * w[i];
      }
    }
  }
  if (beams) interpolate_inside_beams(assembled.assembly, [&](int n) -> Vec3& { return field[n]; });
  return field;
}

std::vector<SettlingTasks> describe_settling(Model& model) {
  std::vector<SettlingTasks> methods;
  if (!model.scene.settle.active) return methods;
  const scene::SettleMethod method = model.scene.settle.method;
  if (method != scene::SettleMethod::relaxation)
    methods.push_back({"Newton's method", describe_plan({newton_tasks(model, {}), {}})});
  if (method != scene::SettleMethod::newton) {
    const RelaxationUpdate update{};
    methods.push_back({"dynamic relaxation", describe_plan(relaxation_plan(model, update))});
  }
  return methods;
}

SettleReport settle(Model& model, const std::function<bool(const SettleReport&)>& go_on, Transport* others) {
  const auto began = std::chrono::steady_clock::now();
  SettleReport report = settle_by(model.scene.settle.method, model, go_on, others);
  if (!std::isfinite(report.unbalance))
    throw InputError(fmt::format(
        "{}: [settle]: forces are no longer finite after {} evaluations: the scene has no equilibrium, or dynamic "
        "relaxation flies past it; hold what can drift away, lower loads that are more than the bodies bear, or leave "
        "[settle] out{}{}",
        model.scene.path, report.steps, report.adrift.empty() ? "" : "; Newton's method before it: ", report.adrift));
  // The run starts from what a file of the state would hold, and from nothing else.
  restore_static_state(model, save_static_state(model));
  report.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return report;
}

SettleReport come_to_rest(Model& model, SettledStates* states, const std::function<bool(const SettleReport&)>& go_on,
                          Transport* others) {
  SettleReport report;
  std::vector<std::string> remarks;
  std::string begun_from;
  if (states != nullptr) {
    SettledStates::Found found = states->find(model);
    if (found.state && !found.state->settled &&
        !(model.scene.settle.keep_unsettled && std::isfinite(found.state->unbalance)))
      found.state.reset();
    if (!found.trouble.empty()) remarks.push_back(found.file + ": " + found.trouble + "; the scene settles anew");
    if (found.state && !restore_static_state(model, *found.state))
      remarks.push_back(found.file + ": is of another model; the scene settles anew");
    else if (found.state)
      begun_from = found.file;
    if (!begun_from.empty() && found.state->settled) {
      report.settled = true;
      report.unbalance = found.state->unbalance;
      report.taken_from = begun_from;
      return report;
    }
  }
  report = settle(model, go_on, others);
  if (states != nullptr && (report.settled || model.scene.settle.keep_unsettled)) {
    StaticState state = save_static_state(model);
    state.settled = report.settled;
    state.unbalance = report.unbalance;
    state.steps = report.steps;
    state.iterations = report.iterations;
    const std::string trouble = states->keep(model, state);
    if (!trouble.empty()) remarks.push_back("the settled state could not be kept: " + trouble);
  }
  report.remarks.insert(report.remarks.end(), remarks.begin(), remarks.end());
  report.begun_from = begun_from;
  return report;
}

}  // namespace railwave
