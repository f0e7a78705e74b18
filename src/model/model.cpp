#include "model/model.hpp"

#include <utility>

#include "case/activity.hpp"
#include "case/memory.hpp"
#include "kernels/support/set_zero.hpp"
#include "model/beams/beams.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/build_steps.hpp"
#include "model/contact/contact_law.hpp"
#include "model/elements/edge_groups.hpp"
#include "model/host_copy.hpp"
#include "model/ranks/block_partition.hpp"
#include "model/ranks/mesh_share.hpp"
#include "model/ranks/rank_share.hpp"
#include "model/visit_arrays.hpp"

namespace railwave {

void build_model(const scene::Scene& scene, Model& model) { build_model(scene, assemble(scene), model); }

void build_bodies(Model& model) {
  weigh_elements(model);
  build_beams(model, model.beams);
  const Activity activity("laying out contacts and ties");
  build_contacts(model, model.contacts);
  choose_algorithms(model, model.contacts);
  build_ties(model, model.contacts, model.ties);
}

namespace {

/// All that there is of a model before its elements' arrays.
void build_surroundings(Model& model) {
  build_bodies(model);
  build_non_reflecting(model, model.contacts, model.ends);
  const Contributions contributions = build_loads(model, model.beams, model);
  build_external_forces(model.assembly, contributions, model.contacts, model.ties, model.ends, model);
  build_set_teams(model.beams, model.external, model);
  build_prescribed_motions(model, model.contacts, model.ties, model, model.prescribed);
  refuse_contradictions(model, model.contacts);
  resolve_rolling(model);
  build_node_masses(model, model.ties, model);
}

void estimate_step(Model& model, Transport* transport) {
  const Activity estimating("estimating the stable step");
  if (transport != nullptr && transport->rank() > 0)
    help_with_stable_step(model, *transport);
  else
    build_stable_step(model, transport);
}

/// Blocks with their nodes, dealt out to ranks, and all that is made of the whole mesh.
void build_lists(Model& model, Transport* transport) {
  build_blocks(model, model.absorbing, model);
  model.order.mesh_number = std::vector<int>();  // no longer asked for
  build_element_histories(model, model);
  if (transport == nullptr) return;
  model.shown_nodes = nodes_of_fields(model.scene, model.assembly);
  deal_out_blocks(model, *transport);
}

}  // namespace

void build_model(const scene::Scene& scene, Assembly assembly, Model& model, Transport* transport) {
  refuse_unknown_methods(scene);
  model.scene = scene;
  model.assembly = std::move(assembly);
  model.gravity = {{scene.gravity[0], scene.gravity[1], scene.gravity[2]}};
  expect_model_memory(model.assembly);
  Activity laying("ordering the elements");
  check_elements(model);
  model.order = order_in_blocks(model.assembly,
                                scene.solver.subcycling ? element_levels(scene, model.assembly) : std::vector<int>{},
                                wants_rows(scene.solver.elements_in_single()));
  model.absorbing = absorbing_layers(scene, model.assembly);
  build_surroundings(model);
  // From here on ranks wait for each other.
  if (transport != nullptr) meet(*transport);
  const int rank = transport != nullptr ? transport->rank() : 0;
  const bool all = transport == nullptr || (rank == 0 && rank_0_needs_all(scene));
  if (all) build_node_places(model.assembly, {}, model.nodes);
  if (all) reset_to_start(model);
  // A search of the step takes the most memory: other ranks than 0 let go of the mesh of others' blocks before.
  if (transport != nullptr) build_lists(model, transport);
  estimate_step(model, transport);
  if (transport == nullptr) build_lists(model, transport);
  if (rank > 0) keep_mesh_of_blocks(model, rank);
  build_gather(model.elements, model);
  if (!all) build_node_places(model.assembly, nodes_of_rank(model, rank), model.nodes);
  fill_blocks(model, model.absorbing, all ? -1 : rank, model);
  model.filled = all;
  build_block_state(model, model.partial);
  build_relative_nodes(model, all ? -1 : rank, model.elements, model.ties, model);
  build_motion_histories(model.ties, model.prescribed, model);
  build_sum_parts(model.nodes.count, model, model);
  model.left_out = what_is_left_out(model.scene);
  reset_to_start(model);
  build_subcycling(model.elements, model.ends, model);
  order_shared_nodes(model.elements, model.contacts, model.prescribed, model.ties, model.ends, transport == nullptr,
                     model);
  if (rank == 0) plan_steps(model.scene, model.subcycling.cycle(), model);
  give_freed_memory_back();
}

namespace {

/// Clears all that a run changes.
struct ZeroState {
  template <class View>
  void operator()(ArrayUse use, const std::string& /*name*/, View& view, ArrayShape /*shape*/) const {
    if (use == ArrayUse::constant || view.span() == 0) return;
    if constexpr (!std::is_const_v<typename View::value_type>) set_zero(view);
  }
};

struct CountBytes {
  std::size_t total = 0;
  template <class View>
  void operator()(ArrayUse /*use*/, const std::string& /*name*/, View& view, ArrayShape /*shape*/) {
    total += view.span() * sizeof(typename View::value_type);
  }
};

}  // namespace

void reset_to_start(Model& model) {
  ZeroState zero;
  visit_model_arrays(zero, model);
  put_at_reference(model.nodes);
  for (const ElementGroup& group : model.elements) renew_frames(model.nodes, group);
  reset_beams(model.beams, model.nodes);
  hold_ends(model.ends, model.nodes.position, {});
  for (ContactPair& pair : model.contacts) {
    Kokkos::deep_copy(pair.arrays.tracked, -1);
    Kokkos::deep_copy(pair.arrays.gap, beside_surface);
    reset_contact_law(*pair.contact, pair.law);
    pair.next_check = pair.near_checked_at = pair.uncounted_of = pair.answer_due = -1;
    pair.asked_motion.forget();
    pair.boxed = false;
    pair.slaves_at_layout = {};
  }
  model.relative.begun = false;
  model.relative.host_motion.clear();
  model.time = 0;
  model.step = 0;
  model.velocity_lag = 0;
}

void fill_rest(Model& model) {
  if (model.filled) return;
  fill_blocks(model, model.absorbing, -1, model);
  set_reference(model.assembly, {}, model.nodes);
  model.filled = true;
}

std::size_t device_bytes(const Model& model) {
  CountBytes bytes;
  // A visit hands out references; this one changes nothing.
  visit_model_arrays(bytes, const_cast<Model&>(model));
  return bytes.total;
}

}  // namespace railwave
