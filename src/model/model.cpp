#include "model/model.hpp"

#include "case/activity.hpp"
#include "model/beams/beams.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/build_steps.hpp"
#include "model/contact/contact_law.hpp"
#include "model/visit_arrays.hpp"

namespace railwave {

void build_model(const scene::Scene& scene, Model& model) { build_model(scene, assemble(scene), model); }

void build_model(const scene::Scene& scene, const Assembly& assembly, Model& model) {
  refuse_unknown_methods(scene);
  model.scene = scene;
  model.assembly = assembly;
  model.gravity = {{scene.gravity[0], scene.gravity[1], scene.gravity[2]}};
  expect_model_memory(model.assembly);
  Activity laying("ordering the elements");
  check_elements(model);
  model.order =
      order_in_blocks(model.assembly, scene.solver.subcycling ? element_levels(scene, assembly) : std::vector<int>{});
  model.absorbing = absorbing_layers(scene, model.assembly);
  build_elements(model, model.absorbing, model, model.partial);
  build_beams(model, model.beams);
  {
    const Activity activity("laying out contacts and ties");
    build_contacts(model, model.contacts);
    choose_algorithms(model, model.contacts);
    build_ties(model, model.contacts, model.ties);
  }
  build_non_reflecting(model, model.contacts, model.ends);
  const Contributions contributions = build_loads(model, model.beams, model);
  build_external_forces(model.assembly, contributions, model.contacts, model.ties, model.ends, model);
  build_prescribed_motions(model, model.prescribed);
  refuse_contradictions(model, model.contacts);
  resolve_rolling(model);
  build_node_arrays(model, model.elements, model.ties, model);
  build_relative_nodes(model, model.elements, model.ties, model);
  build_element_histories(model, model);
  build_motion_histories(model.ties, model.prescribed, model);
  build_sum_parts(model.nodes.count, model, model);
  model.left_out = what_is_left_out(model.scene);
  reset_to_start(model);
  const Activity estimating("estimating the stable step");
  build_stable_step(model);
  build_subcycling(model.elements, model.ends, model);
  order_shared_nodes(model.contacts, model.prescribed, model);
  plan_steps(model.scene, model.subcycling.cycle(), model);
}

namespace {

/// Clears all that a run changes.
struct ZeroState {
  template <class View>
  void operator()(ArrayUse use, const std::string& /*name*/, View& view, ArrayShape /*shape*/) const {
    if (use == ArrayUse::constant || view.span() == 0) return;
    if constexpr (!std::is_const_v<typename View::value_type>) {
      const Kokkos::View<unsigned char*, MemorySpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>> bytes(
          reinterpret_cast<unsigned char*>(view.data()), view.span() * sizeof(typename View::value_type));
      Kokkos::deep_copy(bytes, static_cast<unsigned char>(0));
    }
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
  Kokkos::deep_copy(model.nodes.position, model.nodes.reference);
  for (const ElementGroup& group : model.elements) renew_frames(model.nodes, group);
  reset_beams(model.beams, model.nodes);
  hold_ends(model.ends, model.nodes.position, {});
  for (ContactPair& pair : model.contacts) {
    Kokkos::deep_copy(pair.arrays.tracked, -1);
    Kokkos::deep_copy(pair.arrays.gap, beside_surface);
    reset_contact_law(*pair.contact, pair.law);
    pair.next_check = pair.near_checked_at = -1;
    pair.boxed = false;
    pair.slaves_at_layout = {};
  }
  model.relative.begun = false;
  model.time = 0;
  model.step = 0;
  model.velocity_lag = 0;
}

std::size_t device_bytes(const Model& model) {
  CountBytes bytes;
  // A visit hands out references; this one changes nothing.
  visit_model_arrays(bytes, const_cast<Model&>(model));
  return bytes.total;
}

}  // namespace railwave
