#include "model/model.hpp"

#include <algorithm>
#include <cmath>

#include "case/activity.hpp"
#include "model/absorbing_layer.hpp"
#include "model/beams.hpp"
#include "model/build_steps.hpp"
#include "model/contact_law.hpp"
#include "model/element_histories.hpp"
#include "model/model_room.hpp"
#include "model/non_reflecting.hpp"

namespace railwave {

void build_model(const scene::Scene& scene, Model& model) { build_model(scene, assemble(scene), model); }

void build_model(const scene::Scene& scene, const Assembly& assembly, Model& model) {
  refuse_unknown_methods(scene);
  model.scene = scene;
  model.assembly = assembly;
  expect_model_room(model.assembly);
  Activity laying("ordering the elements");
  check_elements(model);
  model.order =
      order_in_patches(model.assembly, scene.solver.subcycling ? element_levels(scene, assembly) : std::vector<int>{});
  model.absorbing = absorbing_layers(scene, model.assembly);
  build_elements(model);
  build_beams(model);
  {
    const Activity looking("laying out contacts and ties");
    build_contacts(model);
    build_ties(model);
  }
  build_non_reflecting(model);
  build_loads(model);
  build_prescribed_motions(model);
  refuse_contradictions(model);
  resolve_rolling(model);
  build_node_arrays(model);
  build_carried_nodes(model);
  build_element_histories(model);
  model.left_out = what_is_left_out(model.scene);
  reset_to_start(model);
  const Activity estimating("estimating the stable step");
  build_stable_step(model);
  build_subcycling(model);
}

namespace {

template <class View>
void zero(const View& view) {
  if (view.span() > 0) Kokkos::deep_copy(view, typename View::non_const_value_type(0));
}

}  // namespace

void renew_frames(const Model& model, const ElementGroup& group) {
  if (group.patches.frame.extent(0) == 0) return;
  Kokkos::parallel_for("renew_frames", Range(0, group.patches.count),
                       RenewFrames{group.patches, model.nodes.position, model.nodes.reference});
}

void reset_to_start(Model& model) {
  Kokkos::deep_copy(model.nodes.position, model.nodes.reference);
  zero(model.nodes.velocity);
  if (model.partial.wide.extent(0) > 0) Kokkos::deep_copy(model.partial.wide, PartialForce<double>{});
  if (model.partial.narrow.extent(0) > 0) Kokkos::deep_copy(model.partial.narrow, PartialForce<float>{});
  zero(model.extra.sum.load);
  zero(model.extra.sum.contact);
  zero(model.extra.contribution);
  zero(model.extra.work);
  for (auto& group : model.elements) {
    zero(group.patches.hourglass_energy);
    renew_frames(model, group);
    zero(group.plastic.history);
    zero(group.plastic.back_stress);
    zero(group.damping.energy);
  }
  zero(model.connectors.arrays.energy);
  hold_ends(model, {});
  reset_beams(model);
  for (const PrescribedSet& set : model.prescribed) zero(set.work);
  for (auto& pair : model.contacts) {
    const ContactArrays& contact = pair.arrays;
    Kokkos::deep_copy(contact.tracked, -1);
    Kokkos::deep_copy(contact.gap, beside_surface);
    zero(pair.missed);
    zero(contact.entry_depth);
    zero(contact.place);
    zero(contact.normal_force);
    zero(contact.tangential_force);
    zero(contact.status);
    zero(contact.friction_energy);
    zero(pair.multipliers.crowd);
    zero(pair.multipliers.impact_energy);
    reset_contact_law(pair.law, contact.friction);
    pair.next_look = -1;
    pair.boxed = false;
    pair.slaves_at_layout = {};
  }
  model.carried.begun = false;
  model.time = 0;
  model.step = 0;
  model.velocity_lag = 0;
  model.contact_uncleared = false;
}

namespace {

template <class... Views>
std::size_t bytes(const Views&... views) {
  return (std::size_t{0} + ... + (views.span() * sizeof(typename Views::value_type)));
}

}  // namespace

std::size_t device_bytes(const Model& model) {
  const NodeArrays& n = model.nodes;
  const ExtraForces& x = model.extra;
  std::size_t total =
      bytes(n.reference, n.position, n.velocity, n.mass, n.first_partial, n.partial_place, n.extra, n.constraint,
            model.constraints, model.partial.wide, model.partial.narrow, model.listed_nodes,
            model.subcycling.paces.level, x.sum.load, x.sum.contact, x.loaded, x.shares, x.contribution,
            x.contribution_node, x.work, model.sets.first, model.sets.nodes, model.sets.weight, model.sets.first_chunk,
            model.sets.chunks, model.sets.partial, model.sets.sums) +
      beam_bytes(model) + element_history_bytes(model) + model.reduction_space->bytes();
  for (const ElementGroup& group : model.elements) {
    const PatchArrays& p = group.patches;
    total += bytes(p.element_count, p.node_count, p.material, p.node, p.frame_node, p.frame, p.corner, p.first_place,
                   p.place, p.hourglass_scale, p.settling_hourglass, p.hourglass_energy, group.patch_energy,
                   group.constants, group.plastic.constants, group.plastic.history, group.plastic.volume,
                   group.plastic.isotropic_share, group.plastic.back_stress, group.damping.constants,
                   group.damping.node_drag, group.damping.energy, group.carried.local, group.carried.arm);
  }
  const CarriedNodes& carried = model.carried;
  total += bytes(carried.node, carried.listed_arm, carried.motion, carried.steps);
  for (const ContactPair& pair : model.contacts) {
    const ContactArrays& c = pair.arrays;
    total += bytes(c.slave_nodes, c.master_nodes, c.segments, c.first_segment, c.segment_of_node, c.segment_stiffness,
                   c.surface, c.mouth_corners, c.boxes.order, c.boxes.segment, c.boxes.leaf, c.boxes.branch,
                   c.boxes.normal, c.tracked, c.place, c.gap, c.entry_depth, c.normal_force, c.tangential_force,
                   c.status, c.friction_energy, pair.multipliers.rows, pair.multipliers.crowd,
                   pair.multipliers.way_since_stuck, pair.multipliers.impact_energy, pair.law.growth.points,
                   pair.law.friction_now, pair.law.damping_force, pair.law.damping_energy, pair.window.entries,
                   pair.window.near, pair.slaves_at_layout, pair.masters_at_layout);
  }
  for (const PrescribedSet& set : model.prescribed) total += bytes(set.nodes, set.work);
  const NonReflectingArrays& e = model.ends.arrays;
  const TieArrays& t = model.ties.arrays;
  total += bytes(e.nodes, e.dashpot, e.support, e.start, e.force, e.dissipated, t.places, t.master_nodes, t.master_rows,
                 t.first_share, t.shares, t.passed_on, t.before, model.ties.carrier);
  return total;
}

}  // namespace railwave
