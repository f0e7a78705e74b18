#pragma once

#include "kernels/loads/connector.hpp"
#include "kernels/loads/row_loads.hpp"

namespace railwave {

/// A connector, or behind them a torque, and the sets that it concerns: -1: the ground.
struct alignas(16) SetLaw {
  int law, from, to, unused;
};

/// What one team does of SetLoads: first to end of each list.
struct alignas(16) SetTeam {
  int first_chunk, end_chunk;  ///< of NodeSets::chunks
  int first_set, end_set;      ///< of NodeSets::summed
  int first_law, end_law;
  int first_row, end_row;
};

/// Node sets, connectors and torques by teams that wait for no other: sets which a connector joins have the same one.
struct SetTeams {
  int count = 0, with_sets = 0;  ///< others than the first so many have rows alone
  int threads = 1;               ///< of each, on a GPU
  int chunks_at_once = 0;        ///< whose sums a team has in scratch memory
  Array<SetTeam*> teams;
  Array<SetLaw*> laws;
  Array<LoadedRow*> rows;    ///< whose loads one team knows
  Array<LoadedRow*> others;  ///< all other loaded rows, those with few contributions first
  int others_with_few = 0;

  std::size_t scratch_size() const {
    return static_cast<std::size_t>(chunks_at_once) * NodeSets::values * sizeof(double) + scratch_alignment;
  }
};
inline constexpr int most_threads_of_sets = 512;  ///< of a team

/// All that follows from the mean motion of node sets: sums over the sets, connector forces and torques, and the rows
/// that feel no others than their team's.
struct SetLoads {
  SetMotion sets;
  ConnectorForce connectors;
  TorqueNow torques;
  RowLoads rows;
  SetTeams teams;

  /// A law and where its sets are, which is known before their sums are.
  struct PlacedLaw {
    int law = -1;  ///< -1: none
    SetMotion::Placed from, to;
  };

  /// On a GPU a team does little but wait for memory: its threads ask for all that needs no sums before they find
  /// these.
  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    constexpr int shares_at_once = on_device ? 4 : 1;
    const SetTeam own = teams.teams(team.league_rank());
    const int rank = team.team_rank(), size = team.team_size();
    PlacedLaw placed_law;
    if (own.first_law + rank < own.end_law) placed_law = placed(teams.laws(own.first_law + rank));
    RowLoads::Ahead ahead;
    const bool any_row = own.first_row + rank < own.end_row;
    if (any_row) ahead = rows.ask_ahead(teams.rows(own.first_row + rank));
    sum<on_device ? 4 : 1>(team, own);
    team.team_barrier();
    if (placed_law.law >= 0) apply(placed_law);
    for (int k = own.first_law + rank + size; k < own.end_law; k += size) apply(placed(teams.laws(k)));
    team.team_barrier();
    if (any_row) rows.gather<shares_at_once>(ahead);
    for (int k = own.first_row + rank + size; k < own.end_row; k += size) rows.gather<shares_at_once>(teams.rows(k));
  }

  /// Sums and laws alone, beside what takes most registers.
  /// @param t number of a team with sets
  template <class Member>
  KOKKOS_INLINE_FUNCTION void without_rows(const Member& team, int t) const {
    const SetTeam own = teams.teams(t);
    sum<1>(team, own);
    team.team_barrier();
    for (int k = own.first_law + team.team_rank(); k < own.end_law; k += team.team_size()) apply(placed(teams.laws(k)));
  }

  template <int nodes_at_once, class Member>
  KOKKOS_INLINE_FUNCTION void sum(const Member& team, const SetTeam& own) const {
    const int rank = team.team_rank(), size = team.team_size();
    const int first_sum = own.first_set * NodeSets::values + rank, end_sum = own.end_set * NodeSets::values;
    SummedSet first_summed{};
    if (first_sum < end_sum) first_summed = sets.summed_by(first_sum);
    double* const partial = scratch_values<double>(team, teams.chunks_at_once * NodeSets::values);
    for (int first = own.first_chunk; first < own.end_chunk; first += teams.chunks_at_once) {
      const int last = first + teams.chunks_at_once;
      const int end = last < own.end_chunk ? last : own.end_chunk;
      if (first > own.first_chunk) team.team_barrier();
      for (int c = first + rank; c < end; c += size)
        sets.sum_chunk<nodes_at_once>(c, partial + (c - first) * NodeSets::values);
      team.team_barrier();
      for (int k = first_sum; k < end_sum; k += size)
        sets.add_chunks(k, k == first_sum ? first_summed : sets.summed_by(k), first, end, partial);
    }
  }

  KOKKOS_INLINE_FUNCTION PlacedLaw placed(const SetLaw& law) const {
    return {law.law, sets.placed(law.from), sets.placed(law.to)};
  }

  KOKKOS_INLINE_FUNCTION void apply(const PlacedLaw& one) const {
    if (one.law < connectors.connectors.count)
      connectors(sets, one.law, one.from, one.to);
    else
      torques(sets, one.law - connectors.connectors.count, one.to);
  }
};

}  // namespace railwave
