#pragma once

#include <algorithm>
#include <cstddef>

#include "kernels/support/team.hpp"

namespace railwave {

/// Where reductions leave what their blocks have found; grows to what is asked of it, so that only the first ones
/// allocate.
struct ReductionSpace {
  Array<double*> blocks;  ///< of the reduction at work
  Array<double*> left;    ///< of all that are queued
  PinnedArray<double*> fetched;
  Array<unsigned char*> terms;  ///< of sums that have a launch together
  PinnedArray<unsigned char*> terms_given;
  std::size_t terms_there = 0;  ///< bytes of these that the device has
};

/// Threads that reduce items together. A team of a device waits for each item once, where a thread with several waits
/// for one after the other.
inline constexpr int threads_of_reduction = on_device ? 128 : 1;
using ReductionTeams = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<threads_of_reduction>, AsArgument>;

/// Items that a team takes of so many: one a thread unless that made more teams than the host adds up.
inline int items_of_team(int count) {
  constexpr int few = on_device ? threads_of_reduction : 32, most_teams = 512;
  return few * std::max(1, (count + few * most_teams - 1) / (few * most_teams));
}
inline int teams_of(int count) { return (count + items_of_team(count) - 1) / items_of_team(count); }

/// Teams of threads_of_reduction with scratch memory for a value of each thread.
/// @param order in which they come
template <class Value>
ReductionTeams reduction_teams(int teams, const ExecutionSpace& order) {
  ReductionTeams policy(order, teams, threads_of_reduction);
  policy.set_scratch_size(0, Kokkos::PerTeam(threads_of_reduction * sizeof(Value) + scratch_alignment));
  return policy;
}

/// Several sums.
template <int Values>
struct Sums {
  double value[Values];

  KOKKOS_INLINE_FUNCTION void clear() {
    for (int k = 0; k < Values; ++k) value[k] = 0;
  }
  KOKKOS_INLINE_FUNCTION void join(const Sums& other) {
    for (int k = 0; k < Values; ++k) value[k] += other.value[k];
  }
};

/// Joins what the threads of a team have found, in pairs that are always the same, so that sums are too.
/// @param Value has `void join(const Value&)`
/// @param result gets all of it, by the team's first thread
template <class Value, class Member>
KOKKOS_INLINE_FUNCTION void join_team(const Member& team, const Value& found, Value& result) {
  const int rank = team.team_rank(), size = team.team_size();
  Value* const of_thread = scratch_values<Value>(team, size);
  of_thread[rank] = found;
  for (int width = size / 2; width > 0; width /= 2) {
    team.team_barrier();
    if (rank < width) of_thread[rank].join(of_thread[rank + width]);
  }
  if (rank == 0) result = of_thread[0];
}

/// Sums `term(i)` over the items from `begin` to `end`. `Term` has `static constexpr int values` and
/// `void operator()(int, double*) const`, which adds an item's values.
template <class Term, class Member>
KOKKOS_INLINE_FUNCTION void sum_by_team(const Member& team, const Term& term, int begin, int end,
                                        Sums<Term::values>& result) {
  Sums<Term::values> sum;
  sum.clear();
  // Threads of a device side by side read what lies side by side.
  for (int i = begin + team.team_rank(); i < end; i += team.team_size()) term(i, sum.value);
  join_team(team, sum, result);
}

/// Sums `term(i)` over each block of items, by a team.
template <class Term>
struct TeamSum {
  Term term;
  int count, block;  ///< items of all blocks and of one
  Sums<Term::values>* result;

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int begin = team.league_rank() * block, end = count - begin < block ? count : begin + block;
    sum_by_team(team, term, begin, end, result[team.league_rank()]);
  }
};

}  // namespace railwave
