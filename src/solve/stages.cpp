#include "solve/stages.hpp"

#include <algorithm>

#include "kernels/listed_nodes.hpp"
#include "model/carriers.hpp"
#include "model/contact_law.hpp"
#include "model/patch_launch.hpp"
#include "model/prescribed_motion.hpp"
#include "solve/beams.hpp"
#include "solve/contact_multiplier.hpp"
#include "solve/contact_window.hpp"
#include "solve/contributions.hpp"
#include "solve/element_damping.hpp"
#include "solve/element_forces.hpp"
#include "solve/settle_parts.hpp"

namespace railwave {

NodeAdvance node_advance(const Model& model, double step) {
  const Vec3& g = model.scene.gravity;
  return {model.nodes, {{g[0], g[1], g[2]}}, model.velocity_lag + 0.5 * step, step};
}

namespace {

/// Single precision's frames may lag so far behind the bodies' motion: at 30 m/s some tenths of a millimetre, which
/// costs strain a few parts in 1e9. Whole rounds of any levels, so that every patch is evaluated when its frame is due.
constexpr long steps_between_frames = 64;
static_assert(steps_between_frames % (1L << (most_levels - 1)) == 0);

/// Nodes in single precision need frames only for what the account and the outputs compute from the double ones.
bool frames_are_due(const Model& model, const Instant& instant) {
  if (model.carried.active() && !instant.settling) return !instant.advancing;
  return model.step % steps_between_frames == 0;
}

Stage element_stage(Model& model, const ElementGroup& group) {
  const bool viscous = group.hourglass == scene::HourglassType::viscous;
  const auto run = [&model, &group](const Instant& instant) {
    model.patches_have_advanced = instant.advancing;
    if (!instant.settling && group.level > model.subcycling.phase(model.step)) return;
    if (frames_are_due(model, instant)) renew_frames(model, group);
    // While a scene settles its nodes are in double precision whatever the run's own.
    if (!model.scene.solver.elements_in_single())
      element_forces<double, NodeAdvance>(model, group, instant);
    else if (instant.settling || !model.carried.active())
      element_forces<float, NodeAdvance>(model, group, instant);
    else
      element_forces<float, CarriedAdvance>(model, group, instant);
  };
  const char* kind = group.plastic.kinematic() ? ", elastoplastic with back stress"
                     : group.plastic.active()  ? ", elastoplastic"
                                               : "";
  const std::string pace = group.level == 0 ? "" : ", every " + std::to_string(1L << group.level) + " steps";
  return {"elements of " + group.parts + kind + (viscous ? ", viscous" : ", stiffness") + " hourglass control" + pace,
          run};
}

/// Statics know no damping: while the scene settles its rows stay empty.
Stage damping_stage(const Model& model, const ElementGroup& group) {
  return {"damping of " + group.parts, [&model, &group](const Instant& instant) {
            if (instant.settling) return;
            if (group.level > 0 && model.step % (1L << group.level) == 1) book_damping(model, group, instant.elapsed);
            if (group.level > model.subcycling.phase(model.step)) return;
            element_damping(model, group, instant);
          }};
}

/// Before all else: nodes in single precision, and the double ones where somebody looks.
Stage carrier_stage(Model& model) {
  return {"carriers of nodes in single precision", [&model](const Instant& instant) {
            if (instant.settling) return;
            if (!model.carried.begun)
              take_nodes_over(model);
            else if (!instant.advancing)
              give_nodes_back(model);
            lay_carrier_steps(model, instant.step);
          }};
}

/// A load that puts the values of its contributions in place by a kernel of its own.
void apply_load(const Model& model, const LoadArrays& load, const Instant& instant) {
  const double factor = curve_value(load.curve, instant.time);
  const NodeArrays& nodes = model.nodes;
  if (load.load->type == scene::LoadType::pressure) {
    Kokkos::parallel_for("pressure", Range(0, load.count),
                         PressureLoad{model.extra, nodes.position, nodes.velocity, load.first, load.facets,
                                      factor * load.load->pressure, instant.elapsed});
  } else {
    Kokkos::parallel_for("dead_load", Range(0, load.count),
                         DeadLoad{model.extra, nodes.velocity, load.first, load.amplitude, factor, instant.elapsed});
  }
}

Stage load_stage(const Model& model, const LoadArrays& load) {
  return {"load " + load.load->name, [&model, &load](const Instant& instant) { apply_load(model, load, instant); }};
}

using LoadTeam = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<512>, AsArgument>;

/// Sums over sets, and what follows from them.
void launch_set_loads(const Model& model, const SetLoads& all) {
  if (few_sets(model)) return Kokkos::parallel_for("set_loads", LoadTeam(1, on_device ? 512 : 1), all);
  Kokkos::parallel_for("set_chunks", SpreadRange(0, all.chunk_count()), SetChunks{all});
  Kokkos::parallel_for("set_sums", SpreadRange(0, all.sum_count()), SetSums{all});
  Kokkos::parallel_for("set_laws", SpreadRange(0, all.law_count()), SetLaws{all});
}

/// Connectors, torques, and the gather of all loads: one launch where they are few.
Stage set_load_stage(Model& model) {
  const bool sets = model.sets.moving > 0, rows_are_left = !sets || !few_rows(model);
  std::string name = model.extra.contribution_count > 0 ? "gather of loads" : "clearing of loads";
  if (model.torques.count > 0) name = "torques, " + name;
  if (model.connectors.arrays.count > 0) name = "connectors, " + name;
  return {name, [&model, sets, rows_are_left](const Instant& instant) {
            model.rows_are_due = sets_go_along(model, instant);
            model.rows_elapsed = instant.elapsed;
            if (model.rows_are_due) return;
            if (sets) launch_set_loads(model, set_loads(model, instant));
            if (rows_are_left)
              Kokkos::parallel_for("row_loads", SpreadRange(0, model.extra.loaded_count),
                                   row_loads(model, instant.elapsed));
          }};
}

/// After all other forces on their nodes.
Stage non_reflecting_stage(Model& model) {
  return {
      "non-reflecting ends", [&model](const Instant& instant) {
        if (instant.settling) return;
        NonReflectingForce force{model.ends.arrays, model.paced_acceleration(), model.velocity_lag, instant.elapsed};
        force.acceleration.phase = model.subcycling.phase(model.step);
        Kokkos::parallel_for("non_reflecting", SpreadRange(0, model.ends.arrays.count), force);
      }};
}

/// The node update leaves the sum cleared; settling, and forces computed twice at one instant, do not.
Stage contact_clearing_stage(Model& model) {
  return {"clearing of contact forces", [&model](const Instant&) {
            if (model.contact_uncleared) Kokkos::deep_copy(ExecutionSpace(), model.extra.sum.contact, std::uint64_t{0});
            model.contact_uncleared = true;
          }};
}

template <bool Friction>
Stage contact_stage(Model& model, ContactPair& pair) {
  return {"contact " + describe_contact(*pair.contact) + (pair.reversed ? " reversed" : "") +
              describe_contact_law(*pair.contact),
          [&model, &pair](const Instant& instant) {
            keep_window(model, pair, instant);
            if (go_together(model, instant)) return;
            const SpreadRange range(0, pair.window.count);
            if (pair.contact->normals == scene::ContactNormals::smooth)
              Kokkos::parallel_for(
                  "contact_force", range,
                  contact_force<Friction, SmoothNormals>(model, pair, instant, contact_law(model, pair, instant)));
            else if (pair.law.active)
              Kokkos::parallel_for("contact_force", range,
                                   contact_force<Friction>(model, pair, instant, contact_law(model, pair, instant)));
            else
              Kokkos::parallel_for("contact_force", range, contact_force<Friction>(model, pair, instant));
          }};
}

/// With subcycling: the nodes whose own step begins now.
void advance_in_phase(const Model& model, const NodeAdvance& advance_node) {
  const int phase = model.subcycling.phase(model.step);
  PacedNodeUpdate update{model.paced_acceleration(), advance_node, {}};
  update.acceleration.phase = phase;
  if (model.patches_have_advanced) update.listed = model.listed_nodes;
  const int count = model.patches_have_advanced ? model.subcycling.listed_end[phase] : model.nodes.count;
  if (count > 0) Kokkos::parallel_for("paced_nodes", Range(0, count), update);
}

/// Nodes in single precision.
void advance_carried(const Model& model, double step) {
  if (!model.patches_have_advanced)
    for (const ElementGroup& group : model.elements)
      launch_patches(group.patches, CarriedPatchUpdate{group.patches, carried_advance(model, group.carried, step),
                                                       model.partial.narrow, group.first_partial});
  Kokkos::parallel_for(
      "listed_nodes", Range(0, static_cast<int>(model.listed_nodes.extent(0))),
      CarriedListedUpdate{model.acceleration(), carried_advance(model, {}, step), model.listed_nodes,
                          model.carried.listed_arm, row_loads(model, model.rows_elapsed), model.rows_are_due});
}

}  // namespace

Stage tie_stage(Model& model) {
  return {
      "ties", [&model](const Instant&) {
        const TieArrays& ties = model.ties.arrays;
        Kokkos::parallel_for("tie_force", SpreadRange(0, ties.slave_count), TieForce{ties, model.acceleration().force});
        Kokkos::parallel_for("tie_gather", SumTeams(3 * ties.master_count, threads_of_sum),
                             TieGather{ties, ties.master_rows, model.extra.sum.load});
      }};
}

void follow_ties(const Model& model, double step, bool carried) {
  const TieFollow follow{model.ties.arrays, model.nodes, step};
  const SpreadRange slaves(0, model.ties.arrays.slave_count);
  if (carried)
    Kokkos::parallel_for("ties", slaves,
                         CarriedTieFollow{follow, carried_advance(model, {}, step).nodes, model.ties.carrier});
  else
    Kokkos::parallel_for("ties", slaves, follow);
}

std::vector<Stage> force_stages_without_multipliers(Model& model) {
  std::vector<Stage> stages;
  if (model.carried.active()) stages.push_back(carrier_stage(model));
  for (const LoadArrays& load : model.loads)
    if (load.torque < 0 && load.beam_node < 0) stages.push_back(load_stage(model, load));
  if (model.beams) stages.push_back(beam_stage(model));
  if (model.extra.loaded_count > 0) stages.push_back(set_load_stage(model));
  if (!model.contacts.empty()) stages.push_back(contact_clearing_stage(model));
  for (ContactPair& pair : model.contacts)
    if (pair.has_springs())
      stages.push_back(pair.arrays.friction > 0 ? contact_stage<true>(model, pair) : contact_stage<false>(model, pair));
  // Its patches may move their nodes at once, where all else must still find them: all but multipliers, which need the
  // elements' forces and concern no node that a patch moves.
  for (const ElementGroup& group : model.elements) stages.push_back(element_stage(model, group));
  // No patch moves nodes of damped elements by itself.
  for (const ElementGroup& group : model.elements)
    if (group.damping.active()) stages.push_back(damping_stage(model, group));
  return stages;
}

std::vector<Stage> force_stages(Model& model) {
  std::vector<Stage> stages = force_stages_without_multipliers(model);
  if (model.ties.arrays.active()) stages.push_back(tie_stage(model));
  if (model.ends.arrays.count > 0) stages.push_back(non_reflecting_stage(model));
  if (std::any_of(model.contacts.begin(), model.contacts.end(),
                  [](const ContactPair& pair) { return !pair.has_springs(); }))
    stages.push_back(multiplier_stage(model));
  return stages;
}

void advance(Model& model, double step) {
  const NodeAdvance advance_node = node_advance(model, step);
  for (const PrescribedSet& set : model.prescribed)
    Kokkos::parallel_for("prescribed_motion", Range(0, static_cast<int>(set.nodes.extent(0))),
                         prescribed_motion(model, set, step));
  if (model.beams) advance_rotations(model, step);
  if (model.subcycling.levels > 1)
    advance_in_phase(model, advance_node);
  else if (model.carried.active())
    advance_carried(model, step);
  else if (model.patches_have_advanced)
    Kokkos::parallel_for("listed_nodes", Range(0, static_cast<int>(model.listed_nodes.extent(0))),
                         ListedNodeUpdate{model.acceleration(), advance_node, model.listed_nodes,
                                          row_loads(model, model.rows_elapsed), model.rows_are_due});
  else
    Kokkos::parallel_for("node_update", Range(0, model.nodes.count), NodeUpdate{model.acceleration(), advance_node});
  if (model.ties.arrays.active()) follow_ties(model, step, model.carried.active());
  model.patches_have_advanced = model.rows_are_due = false;
  ++model.step;
  model.velocity_lag = 0.5 * step;
  model.contact_uncleared = false;
}

}  // namespace railwave
