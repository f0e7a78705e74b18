#pragma once

#include "kernels/support/team_reduction.hpp"

namespace railwave {

/// Items of lists in parts. The items of a part belong to one block of elements, so that the process which has the
/// block can sum the part alone; its sum does not depend on how blocks are dealt out.
struct PartedItems {
  Array<int*> item;   ///< part after part
  Array<int*> first;  ///< of each part in `item`, one more than parts
};

/// Sums `term(item)` over the items of listed parts, each by a team. `Term` as of sum_by_team().
template <class Term>
struct PartSum {
  /// The term of an item by its place in the list.
  struct Listed {
    static constexpr int values = Term::values;
    const Term& term;
    const Array<int*>& item;
    KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const { term(item(k), sum); }
  };

  Term term;
  PartedItems items;
  Array<const int*> listed;    ///< parts; empty: all
  Sums<Term::values>* result;  ///< by part

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int q = listed.extent(0) == 0 ? team.league_rank() : listed(team.league_rank());
    sum_by_team(team, Listed{term, items.item}, items.first(q), items.first(q + 1), result[q]);
  }
};

}  // namespace railwave
