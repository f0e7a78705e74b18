#include "solve/run_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "kernels/flush_denormals.hpp"
#include "model/beams.hpp"
#include "model/element_precision.hpp"
#include "model/host_copy.hpp"

namespace railwave {

void refuse_state(const std::string& name, const std::string& what) {
  throw std::runtime_error(fmt::format("it does not fit this model: {} {}", name, what));
}

std::string back_end_name() {
  return fmt::format("{} of {} numbers in a pack", ExecutionSpace::name(), lane_count<double>);
}

namespace {

template <class View>
constexpr bool rows_together = View::rank == 1 || std::is_same_v<typename View::array_layout, Kokkos::LayoutRight>;

/// Each value of an array with the place that it has row after row.
template <class View, class Do>
void each_value(const View& host, const Do& one) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < host.extent(0); ++i) {
    if constexpr (View::rank == 1)
      one(host(i), at++);
    else
      for (std::size_t k = 0; k < host.extent(1); ++k) one(host(i, k), at++);
  }
}

template <class View>
void array(StateTaker& taker, const std::string& name, View& view) {
  using Value = typename View::non_const_value_type;
  static_assert(View::rank <= 2);
  if (view.size() == 0) return taker.bytes(name, nullptr, 0);
  const auto host = to_host(view);
  if constexpr (rows_together<View>) return taker.bytes(name, host.data(), view.size() * sizeof(Value));
  std::vector<Value> values(view.size());
  each_value(host, [&](const Value& value, std::size_t at) { values[at] = value; });
  taker.values(name, values);
}

template <class View>
void array(StateLayer& layer, const std::string& name, View& view) {
  using Value = typename View::non_const_value_type;
  const auto& bytes = layer.of(name);
  if (bytes.size() != view.size() * sizeof(Value))
    refuse_state(name, fmt::format("has {} values, not {}", bytes.size() / sizeof(Value), view.size()));
  if (view.size() == 0) return;
  const auto host = Kokkos::create_mirror_view(view);
  const auto* from = reinterpret_cast<const char*>(bytes.data());
  each_value(host,
             [&](Value& value, std::size_t at) { std::memcpy(&value, from + at * sizeof(Value), sizeof(Value)); });
  Kokkos::deep_copy(view, host);
}

/// Of arrays whose length the run changes.
template <class View>
void growing_array(StateTaker& taker, const std::string& name, View& view) {
  array(taker, name, view);
}

template <class View>
void growing_array(StateLayer& layer, const std::string& name, View& view) {
  std::size_t row = sizeof(typename View::non_const_value_type);
  if constexpr (View::rank == 2) row *= view.static_extent(1);
  view = View(Kokkos::view_alloc(view.label().empty() ? name : view.label(), Kokkos::WithoutInitializing),
              layer.of(name).size() / row);
  array(layer, name, view);
}

/// Tiles are as wide as the machine's packs; a state has the values slot after slot.
template <class S, class Do>
void each_tiled(std::size_t size, int values, const Do& one) {
  for (std::size_t at = 0; at < size; ++at)
    one(at, tiled_slot<S>(static_cast<int>(at / values), values, static_cast<int>(at % values)));
}

template <class S>
void tiles(StateTaker& taker, const std::string& name, Array<double*>& view, int values) {
  const auto tiled = to_vector(view);
  std::vector<double> list(tiled.size());
  each_tiled<S>(list.size(), values, [&](std::size_t at, long place) { list[at] = tiled[place]; });
  taker.values(name, list);
}

template <class S>
void tiles(StateLayer& layer, const std::string& name, Array<double*>& view, int values) {
  std::vector<double> list;
  layer.values(name, list);
  if (list.size() != view.size()) refuse_state(name, fmt::format("has {} values, not {}", list.size(), view.size()));
  const auto host = Kokkos::create_mirror_view(view);
  each_tiled<S>(list.size(), values, [&](std::size_t at, long place) { host(place) = list[at]; });
  Kokkos::deep_copy(view, host);
}

template <class Archive>
void archive(Archive& archive, const std::string& of, ContactPair& pair) {
  const auto one = [&](const char* name, auto& view) { array(archive, of + name, view); };
  ContactArrays& contact = pair.arrays;
  one("tracked", contact.tracked);
  one("place", contact.place);
  one("status", contact.status);
  one("gap", contact.gap);
  one("entry_depth", contact.entry_depth);
  one("normal_force", contact.normal_force);
  one("tangential_force", contact.tangential_force);
  one("friction_energy", contact.friction_energy);
  one("friction_now", pair.law.friction_now);
  one("damping_force", pair.law.damping_force);
  one("damping_energy", pair.law.damping_energy);
  one("multiplier_rows", pair.multipliers.rows);
  one("multiplier_crowd", pair.multipliers.crowd);
  one("way_since_stuck", pair.multipliers.way_since_stuck);
  one("impact_energy", pair.multipliers.impact_energy);
  one("missed", pair.missed);
  growing_array(archive, of + "slaves_at_layout", pair.slaves_at_layout);
  growing_array(archive, of + "masters_at_layout", pair.masters_at_layout);
  growing_array(archive, of + "window_entries", pair.window.entries);
  growing_array(archive, of + "window_near", pair.window.near);
  growing_array(archive, of + "window_near_count", pair.window.near_count);
  archive.value(of + "window_count", pair.window.count);
  archive.value(of + "next_look", pair.next_look);
  archive.value(of + "next_near_look", pair.next_near_look);
  archive.value(of + "layouts", pair.layouts);
  archive.value(of + "looks", pair.looks);
}

template <class S, class Archive>
void archive_elements(Archive& archive, const std::string& of, ElementGroup& group) {
  const auto one = [&](const char* name, auto& view) { array(archive, of + name, view); };
  one("frame", group.patches.frame);
  one("hourglass_energy", group.patches.hourglass_energy);
  if (group.plastic.active())
    tiles<S>(archive, of + "plastic_history", group.plastic.history, Bilinear::history_values);
  if (group.plastic.kinematic())
    tiles<S>(archive, of + "back_stress", group.plastic.back_stress, KinematicBilinear::back_values);
  one("damping_energy", group.damping.energy);
  one("carrier_arm", group.carried.arm);
}

template <class Archive>
void archive(Archive& archive, BeamArrays& beams) {
  const auto one = [&](const char* name, auto& view) { array(archive, name, view); };
  one("beam_rotation", beams.rotation);
  one("beam_spin", beams.spin);
  one("beam_stretch", beams.stretch);
  one("beam_moment", beams.moment);
  one("beam_work", beams.work);
}

template <class Archive>
void archive(Archive& archive, CarriedNodes& carried) {
  array(archive, "carried_node", carried.node);
  array(archive, "carried_listed_arm", carried.listed_arm);
  array(archive, "carrier_motion", carried.motion);
  array(archive, "carrier_steps", carried.steps);
  archive.values("carrier_host_motion", carried.host_motion);
  archive.value("carried_begun", carried.begun);
  archive.value("carrier_block_step", carried.block_step);
  archive.value("carrier_block_time", carried.block_time);
  archive.value("carrier_block_size", carried.block_size);
}

template <class Archive>
void archive(Archive& archive_, StableStep& stable) {
  archive_.value("stable_global", stable.global);
  archive_.value("stable_limit", stable.limit);
  archive_.value("stable_springs", stable.springs);
  for (std::size_t p = 0; p < stable.seen.size(); ++p)
    archive_.values(fmt::format("stable_seen_{}", p), stable.seen[p]);
}

/// The forces of an instant are computed anew from what is here, except where work is counted by the trapezoidal rule:
/// that needs the forces of the instant before.
template <class Archive>
void archive(Archive& archive_, Model& model) {
  const auto one = [&](const char* name, auto& view) { array(archive_, name, view); };
  archive_.value("step", model.step);
  archive_.value("step_count", model.step_count);
  archive_.value("step_size", model.step_size);
  archive_.value("time", model.time);
  archive_.value("velocity_lag", model.velocity_lag);
  archive_.value("contact_uncleared", model.contact_uncleared);
  archive(archive_, model.stable_step);
  one("position", model.nodes.position);
  one("velocity", model.nodes.velocity);
  if (model.carried.active()) archive(archive_, model.carried);
  with_element_precision(model.scene, [&](auto number) {
    for (std::size_t g = 0; g < model.elements.size(); ++g)
      archive_elements<decltype(number)>(archive_, fmt::format("elements_{}_", g), model.elements[g]);
  });
  if (std::any_of(model.elements.begin(), model.elements.end(),
                  [](const ElementGroup& group) { return group.damping.active(); })) {
    one("partial_wide", model.partial.wide);
    one("partial_narrow", model.partial.narrow);
  }
  one("extra_load", model.extra.sum.load);
  one("extra_contact", model.extra.sum.contact);
  one("contribution", model.extra.contribution);
  one("contribution_work", model.extra.work);
  one("connector_force", model.connectors.arrays.force);
  one("connector_energy", model.connectors.arrays.energy);
  one("torque_now", model.torques.now);
  if (model.beams) archive(archive_, model.beams->arrays);
  for (std::size_t k = 0; k < model.prescribed.size(); ++k)
    array(archive_, fmt::format("prescribed_{}_work", k), model.prescribed[k].work);
  one("end_support", model.ends.arrays.support);
  one("end_start", model.ends.arrays.start);
  one("end_force", model.ends.arrays.force);
  one("end_dissipated", model.ends.arrays.dissipated);
  one("tie_before", model.ties.arrays.before);
  one("tie_passed_on", model.ties.arrays.passed_on);
  for (std::size_t p = 0; p < model.contacts.size(); ++p)
    archive(archive_, fmt::format("contact_{}_", p), model.contacts[p]);
}

}  // namespace

void take_model_state(Model& model, RunState& state) {
  StateTaker taker(state);
  archive(taker, model);
  state.step = model.step;
  state.time = model.time;
  state.back_end = back_end_name();
}

void lay_model_state(Model& model, const RunState& state) {
  StateLayer layer(state);
  archive(layer, model);
  model.patches_have_advanced = model.rows_are_due = false;
  if (model.carried.begun) flush_denormals();
}

}  // namespace railwave
