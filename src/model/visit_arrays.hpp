#pragma once

#include <string>

#include "model/beams/beams.hpp"
#include "model/elements/element_histories.hpp"
#include "model/model.hpp"
#include "model/time_step/global_step.hpp"

/// Every array of a model, once each. What holds of all of them is made from these visits: the bytes held, what a reset
/// puts back, what a checkpoint keeps. An array that is missing here is found by tests/model/test_visit_arrays.cpp.
namespace railwave {

/// What an array is to a run.
enum class ArrayUse {
  constant,       ///< made with the model
  run_state,      ///< what the rest of a run depends on: zero at the start, kept by checkpoints
  settled_state,  ///< of that, what a settled scene is identified by: kept with it besides
  trial_state,  ///< of that, what each evaluation of forces changes: a trial of settling that is not taken is put back
  scratch       ///< made anew before it is read
};

inline bool is_settled_state(ArrayUse use) { return use == ArrayUse::settled_state || use == ArrayUse::trial_state; }

/// How it lies.
struct ArrayShape {
  int tile = 0;        ///< values of an element in tiles as wide as the elements' packs; 0: row after row
  bool grows = false;  ///< the run changes its length
};

/// Hands arrays on under names that begin alike.
template <class Visitor>
struct Named {
  Visitor& visitor;
  std::string prefix;

  template <class View>
  void operator()(ArrayUse use, const char* name, View& view, ArrayShape shape = {}) const {
    visitor(use, prefix + name, view, shape);
  }
};

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, NodeArrays& nodes) {
  visit(ArrayUse::constant, "reference", nodes.reference);
  visit(ArrayUse::settled_state, "position", nodes.position);
  visit(ArrayUse::run_state, "velocity", nodes.velocity);
  visit(ArrayUse::constant, "mass", nodes.mass);
  visit(ArrayUse::constant, "first_partial", nodes.first_partial);
  visit(ArrayUse::constant, "partial_place", nodes.partial_place);
  visit(ArrayUse::constant, "external_row", nodes.external_row);
  visit(ArrayUse::constant, "constraint", nodes.constraint);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, RelativeNodes& relative) {
  visit(ArrayUse::run_state, "node", relative.node);
  visit(ArrayUse::scratch, "shared_arm", relative.shared_arm);
  visit(ArrayUse::scratch, "motion", relative.motion);
  visit(ArrayUse::run_state, "steps", relative.steps);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, PartedLists& lists) {
  visit(ArrayUse::constant, "part_items", lists.items.item);
  visit(ArrayUse::constant, "first_items", lists.items.first);
  visit(ArrayUse::constant, "own_parts", lists.own_parts);
  visit(ArrayUse::scratch, "part_sums", lists.part_sums);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, ElementGroup& group) {
  ElementBlocks& blocks = group.blocks;
  visit(ArrayUse::constant, "element_count", blocks.element_count);
  visit(ArrayUse::constant, "node_count", blocks.node_count);
  visit(ArrayUse::constant, "material", blocks.material);
  visit(ArrayUse::constant, "node", blocks.node);
  visit(ArrayUse::constant, "frame_node", blocks.frame_node);
  visit(ArrayUse::run_state, "frame", blocks.frame);
  visit(ArrayUse::constant, "corner", blocks.corner);
  visit(ArrayUse::constant, "first_place", blocks.first_place);
  visit(ArrayUse::constant, "place", blocks.place);
  visit(ArrayUse::constant, "edge_count", blocks.edge_count);
  visit(ArrayUse::constant, "edge", blocks.edge);
  visit(ArrayUse::constant, "edge_of_group", blocks.edge_of_group);
  visit(ArrayUse::constant, "hourglass_scale", blocks.hourglass_scale);
  visit(ArrayUse::constant, "settling_hourglass", blocks.settling_hourglass);
  visit(ArrayUse::run_state, "hourglass_energy", blocks.hourglass_energy);
  visit(ArrayUse::scratch, "block_energy", group.block_energy);
  visit(ArrayUse::scratch, "slot_sums", group.slot_sums);
  visit(ArrayUse::scratch, "block_sums", group.block_sums);
  visit(ArrayUse::constant, "own_blocks", group.own_blocks);

  MaterialArrays& material = group.material;
  visit(ArrayUse::constant, "material_constants", material.constants);
  visit(ArrayUse::trial_state, "material_history", material.history, {material.history_values});
  visit(ArrayUse::constant, "reference_volume", material.volume);

  visit(ArrayUse::constant, "damping_constants", group.damping.constants);
  visit(ArrayUse::constant, "node_drag", group.damping.node_drag);
  visit(ArrayUse::run_state, "damping_energy", group.damping.energy);

  visit(ArrayUse::constant, "relative_local", group.relative.local);
  visit(ArrayUse::scratch, "carrier_arm", group.relative.arm);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, ElementHistories& histories) {
  visit(ArrayUse::constant, "item", histories.item);
  visit(ArrayUse::constant, "weight", histories.weight);
  visit(ArrayUse::constant, "corner", histories.corner);
  visit_arrays(visit, histories.parts);
  visit(ArrayUse::scratch, "stress", histories.stress);
  visit(ArrayUse::scratch, "strain", histories.strain);
  visit(ArrayUse::scratch, "plastic_strain", histories.plastic_strain);
  for (ListedElements& listed : histories.listed) {
    visit(ArrayUse::constant, "blocks", listed.blocks);
    visit(ArrayUse::constant, "places", listed.places);
    visit(ArrayUse::scratch, "stress_double", listed.stress_double);
    visit(ArrayUse::scratch, "stress_single", listed.stress_single);
    visit(ArrayUse::scratch, "energy", listed.energy);
  }
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, ExternalForces& external) {
  visit(ArrayUse::run_state, "load", external.sum.load);
  visit(ArrayUse::run_state, "contact", external.sum.contact);
  visit(ArrayUse::constant, "loaded", external.loaded);
  visit(ArrayUse::constant, "loaded_of_row", external.loaded_of_row);
  visit(ArrayUse::constant, "shares", external.shares);
  visit(ArrayUse::run_state, "contribution", external.contribution);
  visit(ArrayUse::constant, "contribution_node", external.contribution_node);
  visit(ArrayUse::run_state, "contribution_work", external.work);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, NodeSets& sets) {
  visit(ArrayUse::constant, "nodes", sets.nodes);
  visit(ArrayUse::constant, "weight", sets.weight);
  visit(ArrayUse::constant, "origin", sets.origin);
  visit(ArrayUse::constant, "summed", sets.summed);
  visit(ArrayUse::constant, "chunks", sets.chunks);
  visit(ArrayUse::scratch, "sums", sets.sums);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, SetTeams& teams) {
  visit(ArrayUse::constant, "teams", teams.teams);
  visit(ArrayUse::constant, "laws", teams.laws);
  visit(ArrayUse::constant, "rows", teams.rows);
  visit(ArrayUse::constant, "others", teams.others);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, MotionHistories& histories) {
  visit(ArrayUse::constant, "node", histories.node);
  visit(ArrayUse::constant, "weight", histories.weight);
  visit_arrays(visit, histories.parts);
  visit(ArrayUse::constant, "driven", histories.driven);
  visit(ArrayUse::constant, "driven_rows", histories.driven_rows);
  visit(ArrayUse::scratch, "driven_change", histories.driven_change);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, LoadArrays& load) {
  visit(ArrayUse::constant, "amplitude", load.amplitude);
  visit(ArrayUse::constant, "facets", load.facets);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, ConnectorArrays& connectors) {
  visit(ArrayUse::constant, "set", connectors.set);
  visit(ArrayUse::constant, "rest", connectors.rest);
  visit(ArrayUse::constant, "axes", connectors.axes);
  visit(ArrayUse::constant, "stiffness", connectors.stiffness);
  visit(ArrayUse::constant, "damping", connectors.damping);
  visit(ArrayUse::constant, "preload", connectors.preload);
  visit(ArrayUse::run_state, "force", connectors.force);
  visit(ArrayUse::run_state, "energy", connectors.energy);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, TorqueArrays& torques) {
  visit(ArrayUse::constant, "set", torques.set);
  visit(ArrayUse::constant, "axis", torques.axis);
  visit(ArrayUse::run_state, "now", torques.now);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, BeamModel& built) {
  BeamArrays& beams = built.arrays;
  visit(ArrayUse::constant, "end", beams.end);
  visit(ArrayUse::constant, "axes", beams.axes);
  visit(ArrayUse::constant, "length", beams.length);
  visit(ArrayUse::constant, "stiffness", beams.stiffness);
  visit(ArrayUse::constant, "bending", beams.bending);
  visit(ArrayUse::settled_state, "stretch", beams.stretch);
  visit(ArrayUse::constant, "pretension", beams.pretension);
  visit(ArrayUse::constant, "tightened", beams.tightened);
  visit(ArrayUse::constant, "node", beams.node);
  visit(ArrayUse::settled_state, "rotation", beams.rotation);
  visit(ArrayUse::run_state, "spin", beams.spin);
  visit(ArrayUse::constant, "inertia", beams.inertia);
  visit(ArrayUse::constant, "constraint", beams.constraint);
  visit(ArrayUse::constant, "projections", beams.projections);
  visit(ArrayUse::constant, "first_moment", beams.first_moment);
  visit(ArrayUse::constant, "moment_of_node", beams.moment_of_node);
  visit(ArrayUse::run_state, "moment", beams.moment);
  visit(ArrayUse::constant, "loaded", beams.loaded);
  visit(ArrayUse::constant, "moment_axis", beams.moment_axis);
  visit(ArrayUse::run_state, "work", beams.work);
  visit(ArrayUse::constant, "relaxation_inertia", built.relaxation_inertia);
  visit(ArrayUse::constant, "arm", built.arm);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, PrescribedSet& set) {
  visit(ArrayUse::constant, "nodes", set.nodes);
  visit(ArrayUse::run_state, "work", set.work);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, NonReflectingArrays& ends) {
  visit(ArrayUse::constant, "nodes", ends.nodes);
  visit(ArrayUse::constant, "dashpot", ends.dashpot);
  visit(ArrayUse::settled_state, "support", ends.support);
  visit(ArrayUse::run_state, "start", ends.start);
  visit(ArrayUse::run_state, "force", ends.force);
  visit(ArrayUse::run_state, "dissipated", ends.dissipated);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, Ties& all) {
  TieArrays& ties = all.arrays;
  visit(ArrayUse::constant, "places", ties.places);
  visit(ArrayUse::constant, "master_nodes", ties.master_nodes);
  visit(ArrayUse::constant, "master_rows", ties.master_rows);
  visit(ArrayUse::constant, "first_share", ties.first_share);
  visit(ArrayUse::constant, "shares", ties.shares);
  visit(ArrayUse::run_state, "passed_on", ties.passed_on);
  visit(ArrayUse::run_state, "before", ties.before);
  visit(ArrayUse::constant, "frame", all.frame);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, ContactPair& pair) {
  ContactArrays& contact = pair.arrays;
  visit(ArrayUse::constant, "slave_nodes", contact.slave_nodes);
  visit(ArrayUse::constant, "master_nodes", contact.master_nodes);
  visit(ArrayUse::constant, "segments", contact.segments);
  visit(ArrayUse::constant, "first_segment", contact.first_segment);
  visit(ArrayUse::constant, "segment_of_node", contact.segment_of_node);
  visit(ArrayUse::constant, "surface", contact.surface);
  visit(ArrayUse::constant, "mouth_corners", contact.mouth_corners);
  visit(ArrayUse::constant, "segment_stiffness", contact.segment_stiffness);
  visit(ArrayUse::constant, "box_order", contact.boxes.order);
  visit(ArrayUse::scratch, "box_segment", contact.boxes.segment);
  visit(ArrayUse::scratch, "box_leaf", contact.boxes.leaf);
  visit(ArrayUse::scratch, "box_branch", contact.boxes.branch);
  visit(ArrayUse::scratch, "box_bough", contact.boxes.bough);
  visit(ArrayUse::scratch, "box_normal", contact.boxes.normal);
  visit(ArrayUse::trial_state, "tracked", contact.tracked);
  visit(ArrayUse::trial_state, "place", contact.place);
  visit(ArrayUse::trial_state, "status", contact.status);
  visit(ArrayUse::trial_state, "gap", contact.gap);
  visit(ArrayUse::run_state, "entry_depth", contact.entry_depth);
  visit(ArrayUse::trial_state, "normal_force", contact.normal_force);
  visit(ArrayUse::trial_state, "tangential_force", contact.tangential_force);
  visit(ArrayUse::run_state, "friction_energy", contact.friction_energy);

  visit(ArrayUse::constant, "penalty_growth", pair.law.growth);
  visit(ArrayUse::trial_state, "law_state", pair.law.state);

  visit(ArrayUse::scratch, "multiplier_rows", pair.multipliers.rows);
  visit(ArrayUse::settled_state, "way_since_stuck", pair.multipliers.way_since_stuck);
  visit(ArrayUse::run_state, "impact_energy", pair.multipliers.impact_energy);

  visit(ArrayUse::run_state, "missed", pair.missed);
  visit(ArrayUse::run_state, "counted", pair.counted, {0, true});
  visit(ArrayUse::run_state, "uncounted", pair.uncounted);
  visit(ArrayUse::run_state, "slaves_at_layout", pair.slaves_at_layout, {0, true});
  visit(ArrayUse::run_state, "masters_at_layout", pair.masters_at_layout, {0, true});
  visit(ArrayUse::run_state, "window_entries", pair.window.entries, {0, true});
  visit(ArrayUse::run_state, "window_near", pair.window.near, {0, true});
  visit(ArrayUse::run_state, "window_near_count", pair.window.near_count, {0, true});
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, FreeNodeArrays& free_nodes) {
  visit(ArrayUse::constant, "shared", free_nodes.shared);
  visit(ArrayUse::scratch, "nodes", free_nodes.nodes);
  visit(ArrayUse::scratch, "multiplicity", free_nodes.multiplicity);
  visit(ArrayUse::scratch, "change", free_nodes.change);
  visit(ArrayUse::scratch, "listed", free_nodes.listed);
  visit(ArrayUse::scratch, "listed_count", free_nodes.listed_count);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, ReductionSpace& space) {
  visit(ArrayUse::scratch, "blocks", space.blocks);
  visit(ArrayUse::scratch, "left", space.left);
  visit(ArrayUse::scratch, "terms", space.terms);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, TangentSprings& springs) {
  const ArrayShape grows{0, true};
  visit(ArrayUse::scratch, "spring_first", springs.first, grows);
  visit(ArrayUse::scratch, "spring_node", springs.node, grows);
  visit(ArrayUse::scratch, "spring_share", springs.share, grows);
  visit(ArrayUse::scratch, "spring_stiffness", springs.stiffness, grows);
  visit(ArrayUse::scratch, "spring_damping", springs.damping, grows);
  visit(ArrayUse::scratch, "spring_force", springs.force, grows);
  visit(ArrayUse::scratch, "with_springs", springs.with_springs, grows);
  visit(ArrayUse::scratch, "first_of_node", springs.first_of_node, grows);
  visit(ArrayUse::scratch, "spring_of_node", springs.spring_of_node, grows);
  visit(ArrayUse::scratch, "share_of_node", springs.share_of_node, grows);
}

template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, TangentOperator& tangent) {
  visit(ArrayUse::constant, "corners", tangent.corners_);
  visit(ArrayUse::constant, "first_corner", tangent.first_corner_);
  visit(ArrayUse::constant, "corner", tangent.corner_);
  visit(ArrayUse::scratch, "corner_force", tangent.corner_force_);
  visit_arrays(visit, tangent.springs_);
}

/// Each estimate makes its springs and its start vector anew.
template <class Visitor>
void visit_arrays(const Named<Visitor>& visit, GlobalEstimate& estimate) {
  visit_arrays(visit, estimate.tangent_);
  visit(ArrayUse::scratch, "now", estimate.now_);
  visit(ArrayUse::scratch, "before", estimate.before_);
  visit(ArrayUse::scratch, "image", estimate.image_);
  visit(ArrayUse::scratch, "displacement", estimate.displacement_);
  visit(ArrayUse::scratch, "products", estimate.products_);
}

/// All of a model. Names are `module_array` or `module_number_array`.
template <class Visitor>
void visit_model_arrays(Visitor& visitor, Model& model) {
  const auto of = [&](const std::string& prefix) { return Named<Visitor>{visitor, prefix}; };
  const auto each = [&](const std::string& module, auto& list) {
    for (std::size_t k = 0; k < list.size(); ++k) visit_arrays(of(module + "_" + std::to_string(k) + "_"), list[k]);
  };
  visit_arrays(of("nodes_"), model.nodes);
  visit_arrays(of("carried_"), model.relative);
  each("elements", model.elements);
  visit_arrays(of("sums_over_nodes_"), model.node_parts);
  if (model.element_histories) visit_arrays(of("element_histories_"), *model.element_histories);
  visit_arrays(of("extra_"), model.external);
  visit_arrays(of("sets_"), model.sets);
  visit_arrays(of("motion_histories_"), model.motion_histories);
  each("load", model.loads);
  visit_arrays(of("connectors_"), model.connectors.arrays);
  visit_arrays(of("torques_"), model.torques);
  visit_arrays(of("set_teams_"), model.set_teams);
  if (model.beams) visit_arrays(of("beams_"), *model.beams);
  each("prescribed", model.prescribed);
  visit_arrays(of("ends_"), model.ends.arrays);
  visit_arrays(of("ties_"), model.ties);
  each("contact", model.contacts);
  visit_arrays(of("free_nodes_"), model.free_nodes);
  visit_arrays(of("reductions_"), *model.reduction_space);
  if (model.global_estimate) visit_arrays(of("global_estimate_"), *model.global_estimate);
  const Named<Visitor> own = of("model_");
  own(ArrayUse::constant, "constraints", model.constraints);
  own(ArrayUse::constant, "shared_nodes", model.shared.nodes);
  own(ArrayUse::constant, "special_nodes", model.shared.special);
  own(ArrayUse::constant, "own_nodes", model.own_nodes);
  own(ArrayUse::constant, "more_places", model.partial.more);
  own(ArrayUse::constant, "node_levels", model.subcycling.node_levels.level);
  // The account of damping takes the rows of the step before.
  bool damped = false;
  for (const ElementGroup& group : model.elements) damped = damped || group.damping.active();
  own(damped ? ArrayUse::run_state : ArrayUse::scratch, "partial_double", model.partial.in_double);
  own(damped ? ArrayUse::run_state : ArrayUse::scratch, "partial_single", model.partial.in_single);
}

}  // namespace railwave
