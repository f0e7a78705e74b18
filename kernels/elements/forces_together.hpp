#pragma once

#include "kernels/contact/contact_force.hpp"
#include "kernels/elements/element_force.hpp"
#include "kernels/loads/set_loads.hpp"

namespace railwave {

/// What a step computes besides the elements, in the same launch: on a GPU few threads work long on sets and contact,
/// and beside the elements they cost no time of their own. Nothing here reads what another part writes: contact and
/// sets read nodes that no block moves by itself.
template <class Block, bool Friction>
struct ForcesTogether {
  SetLoads set_loads;
  ContactForce<Friction> contact;
  Block blocks;
  int set_teams;  ///< 0 where no load follows from a set
  int contact_teams;

  /// Slaves that one team takes at once: few, for it is the longest of them that the team waits for.
  static constexpr int slaves_of_team = 32;

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    const int rank = team.league_rank();
    if (rank < set_teams) {
      set_loads.without_rows(team, rank);
    } else if (rank < set_teams + contact_teams) {
      if (team.team_rank() >= slaves_of_team) return;
      const int near_count = contact.window.near_count(0);
      for (int i = (rank - set_teams) * slaves_of_team + team.team_rank(); i < near_count;
           i += contact_teams * slaves_of_team)
        contact(i);
    } else {
      blocks.run(team, rank - set_teams - contact_teams);
    }
  }
};

}  // namespace railwave
