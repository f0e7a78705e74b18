#pragma once

#include "model/parted_lists.hpp"
#include "model/sample_sums.hpp"

namespace railwave {

/// Sums the process's parts.
/// @param term see sum_by_team(); it gets items' numbers among all
template <class Term>
void sum_parts(const PartedLists& lists, const Term& term) {
  constexpr int values = Term::values;
  const int parts = lists.whole ? lists.part_count() : static_cast<int>(lists.own_parts.extent(0));
  if (parts == 0) return;
  Kokkos::parallel_for(
      "sum_parts", reduction_teams<Sums<values>>(parts),
      PartSum<Term>{term, lists.items, lists.own_parts, reinterpret_cast<Sums<values>*>(lists.part_sums.data())});
}

/// Queues the sums of all lists from those of their parts.
/// @param use use(list, const double* sum) gets Values numbers of each list at the next fetch()
template <int Values, class Use>
void queue_lists(const PartedLists& lists, SampleSums& sums, const Use& use) {
  for (int l = 0; l < lists.list_count(); ++l) {
    const int begin = lists.first_part[l], end = lists.first_part[l + 1];
    sums.sum(LeftSum<Values>{lists.part_sums.data() + static_cast<long>(begin) * Values}, end - begin,
             [use, l](const double* sum) { use(l, sum); });
  }
}

}  // namespace railwave
