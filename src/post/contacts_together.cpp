#include "post/contact_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <unordered_map>

namespace railwave {
namespace {

/// What a side has at its nodes.
struct NodalArray {
  std::vector<double> ContactSide::*values;
  std::size_t components;
  bool adds;  ///< over the contacts that have the node; else each has the same
};
constexpr NodalArray nodal_arrays[] = {{&ContactSide::area, 1, false},           {&ContactSide::position, 3, false},
                                       {&ContactSide::velocity, 3, false},       {&ContactSide::normal, 3, false},
                                       {&ContactSide::displacement, 3, false},   {&ContactSide::normal_force, 3, true},
                                       {&ContactSide::tangential_force, 3, true}};

/// One side of all states.
struct SidesTogether {
  ContactSide all;
  std::unordered_map<int, int> place;  ///< by model node number
  std::set<std::array<int, 4>> known;  ///< facets by their sorted corners

  /// Where each of the side's nodes is in the whole.
  std::vector<int> add(const ContactSide& side) {
    std::vector<int> places;
    for (std::size_t n = 0; n < side.nodes.size(); ++n) {
      const auto [found, added] = place.try_emplace(side.nodes[n], static_cast<int>(all.nodes.size()));
      places.push_back(found->second);
      if (added) all.nodes.push_back(side.nodes[n]);
      for (const auto& [values, components, adds] : nodal_arrays) {
        if ((side.*values).empty()) continue;
        const double* own = (side.*values).data() + components * n;
        std::vector<double>& whole = all.*values;
        const std::size_t first = components * static_cast<std::size_t>(found->second);
        if (added) whole.insert(whole.end(), own, own + components);
        if (!added && adds && first + components <= whole.size())  // shorter: a side before lacked it
          for (std::size_t i = 0; i < components; ++i) whole[first + i] += own[i];
      }
    }
    for (std::array<int, 4> facet : side.facets) {
      for (int& corner : facet) corner = places[corner];
      std::array<int, 4> corners = facet;
      std::sort(corners.begin(), corners.end());
      if (known.insert(corners).second) all.facets.push_back(facet);
    }
    return places;
  }

  /// Without what one of the sides lacked.
  ContactSide finished() {
    for (const auto& [values, components, adds] : nodal_arrays)
      if ((all.*values).size() != components * all.nodes.size()) (all.*values).clear();
    return std::move(all);
  }
};

}  // namespace

ContactState contacts_together(const std::vector<ContactState>& states) {
  if (states.empty()) throw std::logic_error("no contacts to take together");
  SidesTogether slave, master;
  std::vector<std::vector<int>> places;
  for (const ContactState& state : states) {
    places.push_back(slave.add(state.slave));
    master.add(state.master);
  }
  ContactState whole;
  whole.slave = slave.finished();
  whole.master = master.finished();
  whole.friction = states.front().friction;
  const std::size_t count = whole.slave.nodes.size();
  const auto all_have = [&](auto member) {
    return std::all_of(states.begin(), states.end(), [&](const ContactState& state) {
      return state.slave.nodes.empty() || !(state.*member).empty();
    });
  };
  if (all_have(&ContactState::gap)) whole.gap.assign(count, std::numeric_limits<double>::quiet_NaN());
  if (all_have(&ContactState::slip_velocity)) whole.slip_velocity.assign(3 * count, 0);
  if (all_have(&ContactState::slipping)) whole.slipping.assign(count, 0);
  whole.friction_now.assign(count, whole.friction);
  std::vector<double> largest(count, -1);  // normal force of the contact by which the node slips
  for (std::size_t s = 0; s < states.size(); ++s) {
    const ContactState& state = states[s];
    whole.name += (s == 0 ? "" : "+") + state.name;
    for (std::size_t n = 0; n < state.slave.nodes.size(); ++n) {
      const int place = places[s][n];
      if (!whole.gap.empty()) whole.gap[place] = std::fmin(whole.gap[place], state.gap[n]);
      const double* force = &state.slave.normal_force[3 * n];
      const double size = std::hypot(force[0], force[1], force[2]);
      if (size <= largest[place]) continue;
      largest[place] = size;
      whole.friction_now[place] = state.friction_at(n);
      if (!whole.slipping.empty()) whole.slipping[place] = state.slipping[n];
      for (int i = 0; i < 3 && !whole.slip_velocity.empty(); ++i)
        whole.slip_velocity[3 * place + i] = state.slip_velocity[3 * n + i];
    }
  }
  return whole;
}

}  // namespace railwave
