#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "kernels/support/reductions.hpp"
#include "model/beams/beams.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/host_copy.hpp"
#include "solve/plan.hpp"
#include "solve/ranks/static_parts.hpp"
#include "solve/statics/settle.hpp"
#include "solve/statics/static_coarse.hpp"
#include "solve/statics/static_contact.hpp"
#include "solve/statics/static_state.hpp"
#include "solve/statics/static_tangent.hpp"
#include "solve/tasks/beam_forces.hpp"

namespace railwave {
namespace {

/// Conjugate gradients stop at this share of the residual they began with, between these bounds, in the norm of the
/// preconditioner; and not before the forces that they leave unbalanced are this share of those they began with. The
/// norm alone is not enough: where a body sinks on soft supports it is that motion's energy, and a hundredth of it left
/// in stiff elements was ten times the unbalanced force of before.
constexpr double loosest = 0.01, tightest = 1e-3, share_of_forces = 0.3;
/// Less than this share of the forces with which a scene counts as settled is not asked for.
constexpr double settled_share = 0.3;
constexpr int most_iterations = 600;
constexpr int iterations_between_checks = 20, iterations_between_forces = 10;
/// A step is taken when the force along it has come down to this share of what it was, either way.
constexpr double taken_share = 0.7;
constexpr int most_trials = 20;
/// A rotation turns no farther at once, rad: its moments have changed by then.
constexpr double most_turn = 0.5;
/// Share of the diagonal that is added to the stiffness: much where contact has still to close, and a body that nothing
/// holds would turn by angles that strain it; raised where less than about half of a step could be taken (a body that
/// nothing holds would go far) or things got worse, and lowered where not; to no less than a floor that rises while
/// nothing improves, for bodies that slide away without friction.
constexpr double least_shift = 1e-12, most_shift = 1e-5, shift_up = 100, shift_down = 10, worse = 2;
constexpr double nearly_whole = 0.5;
constexpr int idle_steps_of_floor = 3;
/// Newton steps without a better residual after which it is given up.
constexpr int most_idle_steps = 25;
/// Newton steps in which the residual has to halve where something else can be tried.
constexpr int patience = 12;
/// Unbalance that friction may hold in the end where the scene is to settle without it: more is no rest of edges.
constexpr double most_held = 0.02;
constexpr int no_limit = std::numeric_limits<int>::max();
/// Multipliers are renewed when the unbalance is below that many tolerances, or the tolerance where it is more than the
/// most. Pressures of a state far from rest mislead: the joint that may be left 0.5 % unbalanced, renewed from 15 % on,
/// came to 2.5 % and went no further; from 3 % on it settles.
constexpr double renewal_unbalance = 30, most_renewal_unbalance = 0.03;
/// Change of a multiplier, over the largest one, at which they count as found: what is left of the gaps would take as
/// much off the penalty springs.
constexpr double multiplier_tolerance = 1e-3;

struct Measure {
  double unbalance = 0;  ///< sum of |unbalanced force| over sum of |applied and contact force|
  double along = 0;      ///< J, unbalanced force times the step
  double applied = 0;    ///< N
};

class Newton {
 public:
  /// @param before whose evaluations of forces and steps are counted on
  Newton(Model& model, const std::function<bool(const SettleReport&)>& go_on, StaticParts* parts,
         const SettleReport& before)
      : model_(model),
        go_on_(go_on),
        unknowns_(model, model.ties, model.ends, model.beams),
        contact_(model, model, model.contacts),
        forces_(newton_tasks(model, [this] { contact_.press(); })),
        tangent_(model, model.nodes, unknowns_, parts),
        coarse_(model.assembly, model.nodes.position, tangent_),
        residual_{model.acceleration(),
                  to_device("centrifugal field", centrifugal_field(model, model.nodes.reference, model.beams)),
                  unknowns_.held(), vector("residual")},
        origin_("origin", model.nodes.count),
        step_(vector("static step")),
        left_(vector("left residual")),
        z_(vector("preconditioned")),
        way_(vector("search direction")),
        image_(vector("image")) {
    if (model.beams) turned_from_ = Array<double* [4]>("turned from", unknowns_.rotations());
    report_.steps = before.steps;
    report_.iterations = before.iterations;
  }

  /// @param most_slow_steps it is given up when so many Newton steps have not halved the residual
  SettleReport run(int most_slow_steps = no_limit) {
    const scene::Settle& wish = model_.scene.settle;
    const double renewal =
        std::max(wish.tolerance, std::min(most_renewal_unbalance, renewal_unbalance * wish.tolerance));
    trial_.keep(model_);
    Measure now = evaluate();
    if (contact_.any()) shift_ = most_shift;
    refuse_drifting_points(model_, model_.connectors.cells, model_.beams, residual_.residual, now.applied);
    double best = 1e300, halved = 1e300;
    int idle = 0, slow = 0;
    for (;; ++report_.iterations) {
      double change = 0;
      if (contact_.augmented()) {
        change = 1;
        if (now.unbalance < renewal) change = contact_.renew_multipliers();
      }
      report_.unbalance = now.unbalance;
      report_.settled = now.unbalance < wish.tolerance && change < std::min(multiplier_tolerance, wish.tolerance);
      if (!report_.settled && contact_.augmented() && change < 1) {
        // The multipliers press in the springs' place, and these press on until the gaps are gone.
        trial_.keep(model_);
        go_back();
        now = evaluate();
      }
      if (report_.settled || !std::isfinite(now.unbalance) || !go_on_(report_)) break;
      idle = now.unbalance < 0.95 * best ? 0 : idle + 1;
      best = std::min(best, now.unbalance);
      // While multipliers are renewed it cannot fall.
      const bool renews = contact_.augmented() && now.unbalance < renewal;
      slow = renews || best < 0.5 * halved ? 0 : slow + 1;
      if (slow == 0) halved = best;
      if (idle > 0 && idle % idle_steps_of_floor == 0) floor_ = std::min(most_shift, shift_up * floor_);
      if (idle > most_idle_steps || slow > most_slow_steps || report_.steps >= wish.max_steps) break;
      trial_.keep(model_);
      if (!find_step(now)) break;
      now = go(now.unbalance);
    }
    if (!report_.settled) report_.adrift = what_drifts(model_, residual_.residual, now.applied);
    hold_ends();
    tighten_beams(model_.beams, model_.nodes, false);
    return report_;
  }

 private:
  NodeVector vector(const char* name) const { return NodeVector(std::string(name), unknowns_.rows()); }
  Range nodes() const { return Range(0, unknowns_.nodes()); }
  Range all() const { return Range(0, unknowns_.rows()); }

  double inner(const NodeVector& a, const NodeVector& b) const {
    double sum = 0;
    block_sum(InnerProduct{a, b}, unknowns_.rows(), &sum, *model_.reduction_space);
    return sum;
  }

  /// N, of the nodes.
  double total_force(const NodeVector& forces) const {
    double sum = 0;
    block_sum(SumOfLengths{forces}, unknowns_.nodes(), &sum, *model_.reduction_space);
    return sum;
  }

  void go_back() {
    trial_.restore(model_);
    contact_.search_anew();
  }

  /// Forces at the present places, from the kept contact.
  Measure evaluate() {
    ++report_.steps;
    Instant instant;
    instant.step = 1;
    run_tasks(forces_, instant, model_.step);
    Kokkos::parallel_for("static_residual", nodes(), residual_);
    double sum[2];
    block_sum(StaticUnbalance{residual_}, unknowns_.nodes(), sum, *model_.reduction_space);
    if (model_.beams) add_moments(sum);
    sum[1] = applied_(sum[1]);
    return {sum[1] > 0 ? sum[0] / sum[1] : sum[0], inner(residual_.residual, step_), sum[1]};
  }

  /// Moments count as forces on the arm of an element, as in a relaxation.
  void add_moments(double (&sum)[2]) {
    const BeamNodeMoment rotation{model_.beams->arrays};
    Kokkos::parallel_for("static_moment", Range(0, unknowns_.rotations()),
                         StaticMoment{rotation, unknowns_.nodes(), residual_.residual});
    const BeamRelaxationState beams = relaxation_state(*model_.beams, *model_.reduction_space);
    sum[0] += beams.unbalanced;
    sum[1] += beams.applied;
  }

  Measure evaluate_at(double share) {
    go_back();
    Kokkos::parallel_for("go_along", nodes(), GoAlong{model_.nodes.position, origin_, step_, share});
    const TieArrays& ties = model_.ties.arrays;
    if (ties.active())
      Kokkos::parallel_for("place_slaves", Range(0, ties.slave_count), PlaceSlaves{ties, model_.nodes.position});
    if (model_.beams)
      Kokkos::parallel_for("turn_along", Range(0, unknowns_.rotations()),
                           TurnAlong{{model_.beams->arrays}, unknowns_.nodes(), turned_from_, step_, share});
    return evaluate();
  }

  /// Solves K step = residual. @return false when asked to stop
  bool find_step(const Measure& now) {
    SpringCollector springs;
    springs.add_connectors(model_.scene, model_.connectors.cells);
    springs.add_beams(model_.beams, model_.nodes);
    contact_.add_springs(springs);
    tangent_.set_springs(springs, shift_);
    coarse_.factor(springs);
    Kokkos::deep_copy(step_, 0.0);
    Kokkos::deep_copy(left_, residual_.residual);
    coarse_.precondition(left_, z_);
    Kokkos::deep_copy(way_, z_);
    double square = inner(left_, z_);
    const double wanted = std::max(tightest, std::min(loosest, 0.2 * model_.scene.settle.tolerance / now.unbalance));
    const double enough = wanted * wanted * square;
    const double forces_enough =
        std::max(share_of_forces * total_force(left_), settled_share * model_.scene.settle.tolerance * now.applied);
    bool close = false;
    for (int k = 1; k <= most_iterations && !close; ++k) {
      tangent_.apply(way_, image_);
      ++report_.steps;
      const double curvature = inner(way_, image_);
      if (!(curvature > 0)) break;
      Kokkos::parallel_for("conjugate_step", all(), ConjugateStep{step_, left_, way_, image_, square / curvature});
      coarse_.precondition(left_, z_);
      const double before = square;
      square = inner(left_, z_);
      Kokkos::parallel_for("conjugate_turn", all(), ConjugateTurn{way_, z_, square / before});
      if (k % iterations_between_checks == 0 && !go_on_(report_)) return false;
      if (square <= enough && (square == 0 || k % iterations_between_forces == 0))
        close = total_force(left_) <= forces_enough;
    }
    unknowns_.lead_slaves(step_);
    return true;
  }

  /// Largest share of the step that moves no node of a contact surface farther than a segment, so that none passes
  /// through another, and turns no rotation too far.
  double largest_share() const {
    if (!contact_.any() && !model_.beams) return 1;
    const auto step = to_host(step_);
    double farthest = 0, turned = 0;
    const auto consider = [&](int n, double& most) {
      most = std::max(most, std::sqrt(step(n, 0) * step(n, 0) + step(n, 1) * step(n, 1) + step(n, 2) * step(n, 2)));
    };
    for (const ContactPair& pair : model_.contacts)
      for (const auto* of_surface : {&pair.slave_nodes, &pair.master_nodes})
        for (int n : *of_surface) consider(n, farthest);
    for (int r = unknowns_.nodes(); r < unknowns_.rows(); ++r) consider(r, turned);
    double share = 1;
    if (farthest > 0) share = std::min(share, contact_.smallest_segment() / farthest);
    if (turned > 0) share = std::min(share, most_turn / turned);
    return share;
  }

  /// Goes along the step until the force along it has come down. Regula falsi of the Illinois kind between two places
  /// at which that force has different signs.
  Measure go(double unbalance_before) {
    Kokkos::deep_copy(origin_, model_.nodes.position);
    if (model_.beams) Kokkos::deep_copy(turned_from_, model_.beams->arrays.rotation);
    const double first = inner(residual_.residual, step_);
    double low = 0, at_low = first, high = 0, at_high = 0, share = largest_share();
    Measure now{};
    for (int trial = 0; trial < most_trials; ++trial) {
      now = evaluate_at(share);
      const bool too_far = !std::isfinite(now.unbalance) || !std::isfinite(now.along);
      // Still pulled on: beyond the step's end nothing is known.
      if (!too_far && now.along >= 0 && high == 0) break;
      if (!too_far && std::fabs(now.along) <= taken_share * first) break;
      if (too_far || now.along < 0) {
        if (high > 0 && !too_far) at_low *= 0.5;
        high = share;
        at_high = too_far ? -1e3 * first : now.along;
      } else {
        at_high *= 0.5;
        low = share;
        at_low = now.along;
      }
      share = low + (high - low) * std::max(1e-3, std::min(0.9, at_low / (at_low - at_high)));
    }
    const bool well = share >= nearly_whole && now.unbalance < worse * unbalance_before;
    shift_ = well ? std::max(floor_, shift_ / shift_down) : std::min(most_shift, shift_up * shift_);
    return now;
  }

  /// The ends' supports take over what is left on their nodes.
  void hold_ends() {
    if (model_.ends.nodes.empty()) return;
    Kokkos::parallel_for("static_reaction", nodes(), StaticReaction{residual_, image_});
    railwave::hold_ends(model_.ends, model_.nodes.position, image_);
  }

  Model& model_;
  const std::function<bool(const SettleReport&)>& go_on_;
  SettleReport report_;
  StaticUnknowns unknowns_;
  StaticContact contact_;
  TrialState trial_;
  std::vector<Task> forces_;
  StaticTangent tangent_;
  StaticCoarse coarse_;
  double shift_ = least_shift, floor_ = least_shift;
  StaticResidual residual_;
  AppliedForces applied_{model_};
  Array<double* [3]> origin_;
  NodeVector step_, left_, z_, way_, image_;
  Array<double* [4]> turned_from_;
};

/// Contacts have friction, or none, as long as this lives.
class FrictionForNow {
 public:
  FrictionForNow(scene::Settle& wish, bool friction) : wish_(wish), before_(wish.friction) { wish.friction = friction; }
  ~FrictionForNow() { wish_.friction = before_; }
  FrictionForNow(const FrictionForNow&) = delete;
  FrictionForNow& operator=(const FrictionForNow&) = delete;

 private:
  scene::Settle& wish_;
  bool before_;
};

bool any_friction(const Model& model) {
  return std::any_of(model.contacts.begin(), model.contacts.end(),
                     [](const ContactPair& pair) { return pair.arrays.friction > 0; });
}

/// Newton's method from where the model is, or from another state. Where it makes nothing better, the model is as it
/// was.
SettleReport go_on_settling(Model& model, const std::function<bool(const SettleReport&)>& go_on, StaticParts* parts,
                            bool friction, const SettleReport& before, int most_slow_steps,
                            const StaticState* from = nullptr) {
  const StaticState reached = save_static_state(model);
  if (from) restore_static_state(model, *from);
  SettleReport report;
  {
    const FrictionForNow own(model.scene.settle, friction);
    report = Newton(model, go_on, parts, before).run(most_slow_steps);
  }
  if (report.settled || report.unbalance < before.unbalance) return report;
  restore_static_state(model, reached);
  report.unbalance = before.unbalance;
  return report;
}

/// For contacts in which many nodes slip: there friction depends on the way, and Newton's steps take a few per cent
/// each off the residual. An equilibrium without friction is one with it too, in which nothing is held back; so the
/// scene settles without friction first and then with it from there, where all nodes stick. Where that leads nowhere,
/// as with bodies that friction alone holds, it goes on from what was tried.
SettleReport settle_without_friction_first(Model& model, const std::function<bool(const SettleReport&)>& go_on,
                                           StaticParts* parts, const StaticState& start, const SettleReport& tried) {
  SettleReport report = go_on_settling(model, go_on, parts, false, tried, patience, &start);
  const bool better = report.unbalance < tried.unbalance;
  report = go_on_settling(model, go_on, parts, true, report, no_limit);
  if (better)
    report.remarks.push_back(
        fmt::format("with friction Newton's method came to an unbalanced force of {:.2g} of all forces in {} "
                    "evaluations; then the scene settled without friction first, and with it from there",
                    tried.unbalance, tried.steps));
  return report;
}

/// Without friction nodes may come to rest in edges between facets, where the force jumps from one normal to the other.
/// Then those that touch stick where they are, and what is left unbalanced, if it is little, is all that they hold.
SettleReport hold_by_friction(Model& model, const std::function<bool(const SettleReport&)>& go_on, StaticParts* parts,
                              const SettleReport& tried) {
  if (tried.unbalance > most_held) return go_on_settling(model, go_on, parts, false, tried, no_limit);
  SettleReport report = go_on_settling(model, go_on, parts, true, tried, no_limit);
  if (!report.settled) return go_on_settling(model, go_on, parts, false, report, no_limit);
  report.remarks.push_back(
      fmt::format("without friction Newton's method came to an unbalanced force of {:.2g} of all forces in {} "
                  "evaluations; nodes in contact stick from there on and hold what is left",
                  tried.unbalance, tried.steps));
  return report;
}

}  // namespace

std::vector<Task> newton_tasks(Model& model, std::function<void()> press) {
  constexpr StepKind kind = StepKind::settling;
  std::vector<Task> tasks = own_force_tasks(model, kind);
  if (std::any_of(model.contacts.begin(), model.contacts.end(), [](const auto& pair) { return !pair.has_springs(); }))
    tasks.push_back({"contact by augmented multipliers", "d", [press](const Instant&) { press(); }});
  append(tasks, tie_tasks(model, model.ties));
  return tasks;
}

SettleReport settle_by_newton(Model& model, const std::function<bool(const SettleReport&)>& go_on, Transport* others) {
  model.step = 0;
  std::unique_ptr<StaticParts> shared;
  if (others != nullptr && StaticParts::possible) shared = std::make_unique<StaticParts>(model, *others);
  StaticParts* const parts = shared.get();
  bool stopped = false;
  const auto go_on_still = [&](const SettleReport& so_far) {
    stopped = stopped || !go_on(so_far);
    return !stopped;
  };
  const bool rubs = any_friction(model), friction = rubs && model.scene.settle.friction;
  const StaticState start = friction ? save_static_state(model) : StaticState{};
  SettleReport report = Newton(model, go_on_still, parts, {}).run(rubs ? patience : no_limit);
  if (rubs && !report.settled && !stopped && report.steps < model.scene.settle.max_steps)
    report = friction ? settle_without_friction_first(model, go_on_still, parts, start, report)
                      : hold_by_friction(model, go_on_still, parts, report);
  for (ContactPair& pair : model.contacts) {
    Kokkos::deep_copy(pair.missed, 0);
    if (!pair.has_springs()) Kokkos::deep_copy(pair.multipliers.way_since_stuck, 0.0);
  }
  return report;
}

}  // namespace railwave
