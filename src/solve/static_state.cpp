#include "solve/static_state.hpp"

#include "model/beams.hpp"
#include "model/non_reflecting.hpp"

namespace railwave {
namespace {

/// Row after row, whatever the array's layout.
template <class View>
auto flat(const View& view) {
  using Value = typename View::non_const_value_type;
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
  std::vector<Value> values;
  values.reserve(view.size());
  for (std::size_t i = 0; i < host.extent(0); ++i) {
    if constexpr (View::rank == 1)
      values.push_back(host(i));
    else
      for (std::size_t k = 0; k < host.extent(1); ++k) values.push_back(host(i, k));
  }
  return values;
}

template <class View, class Value>
void lay(const View& view, const std::vector<Value>& values) {
  if (view.size() == 0) return;
  const auto host = Kokkos::create_mirror_view(view);
  std::size_t at = 0;
  for (std::size_t i = 0; i < host.extent(0); ++i) {
    if constexpr (View::rank == 1)
      host(i) = values[at++];
    else
      for (std::size_t k = 0; k < host.extent(1); ++k) host(i, k) = values[at++];
  }
  Kokkos::deep_copy(view, host);
}

bool suits(const Model& model, const StaticState& state) {
  bool right = state.position.size() == 3 * model.assembly.nodes.size() &&
               state.contacts.size() == model.contacts.size() && state.plastic.size() == model.elements.size();
  for (std::size_t p = 0; right && p < state.contacts.size(); ++p) {
    const StaticState::Contact& contact = state.contacts[p];
    const std::size_t slaves = model.contacts[p].slave_nodes.size();
    right = contact.tracked.size() == slaves && contact.status.size() == slaves && contact.place.size() == 2 * slaves &&
            contact.gap.size() == slaves && contact.normal_force.size() == 3 * slaves &&
            contact.tangential_force.size() == 3 * slaves &&
            contact.way_since_stuck.size() == model.contacts[p].multipliers.way_since_stuck.size();
    const int segments = static_cast<int>(model.contacts[p].master_segments.size());
    for (int segment : contact.tracked) right = right && segment >= -1 && segment < segments;
  }
  right = right && state.back_stress.size() == state.plastic.size();
  for (std::size_t g = 0; right && g < state.plastic.size(); ++g)
    right = state.plastic[g].size() == model.elements[g].plastic.history.size() &&
            state.back_stress[g].size() == model.elements[g].plastic.back_stress.size();
  const std::size_t beam_nodes = model.beams ? model.beams->arrays.node_count : 0,
                    beams = model.beams ? model.beams->arrays.count : 0;
  return right && state.beam_rotation.size() == 4 * beam_nodes && state.beam_stretch.size() == beams &&
         state.end_support.size() == 3u * model.ends.arrays.count;
}

}  // namespace

StaticState take_static_state(const Model& model) {
  StaticState state;
  state.position = flat(model.nodes.position);
  for (const ContactPair& pair : model.contacts) {
    const ContactArrays& contact = pair.arrays;
    state.contacts.push_back({flat(contact.tracked), flat(contact.status), flat(contact.place), flat(contact.gap),
                              flat(contact.normal_force), flat(contact.tangential_force),
                              flat(pair.multipliers.way_since_stuck)});
  }
  for (const ElementGroup& group : model.elements) {
    state.plastic.push_back(flat(group.plastic.history));
    state.back_stress.push_back(flat(group.plastic.back_stress));
  }
  if (model.beams) {
    state.beam_rotation = flat(model.beams->arrays.rotation);
    state.beam_stretch = flat(model.beams->arrays.stretch);
  }
  if (model.ends.arrays.count > 0) state.end_support = flat(model.ends.arrays.support);
  return state;
}

bool lay_static_state(Model& model, const StaticState& state) {
  if (!suits(model, state)) return false;
  reset_to_start(model);
  lay(model.nodes.position, state.position);
  for (const ElementGroup& group : model.elements) renew_frames(model, group);
  for (std::size_t p = 0; p < state.contacts.size(); ++p) {
    const StaticState::Contact& from = state.contacts[p];
    const ContactArrays& contact = model.contacts[p].arrays;
    lay(contact.tracked, from.tracked);
    lay(contact.status, from.status);
    lay(contact.place, from.place);
    lay(contact.gap, from.gap);
    lay(contact.normal_force, from.normal_force);
    lay(contact.tangential_force, from.tangential_force);
    lay(model.contacts[p].multipliers.way_since_stuck, from.way_since_stuck);
  }
  for (std::size_t g = 0; g < state.plastic.size(); ++g) {
    lay(model.elements[g].plastic.history, state.plastic[g]);
    lay(model.elements[g].plastic.back_stress, state.back_stress[g]);
  }
  if (model.beams) {
    lay(model.beams->arrays.rotation, state.beam_rotation);
    lay(model.beams->arrays.stretch, state.beam_stretch);
  }
  hold_ends(model, {});  // from where they are now
  lay(model.ends.arrays.support, state.end_support);
  return true;
}

}  // namespace railwave
