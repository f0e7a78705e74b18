#pragma once

#include "kernels/support/joined_sums.hpp"
#include "kernels/support/reductions.hpp"
#include "model/parted_lists.hpp"

namespace railwave {

struct AmplitudeSum;
struct BeamEnergy;
struct BeamKineticEnergy;
struct BlockTotals;
struct ConnectorEnergy;
struct FacetSum;
struct GrowingPenalty;
struct LinearPenalty;
struct MasterSums;
struct MultiplierEnergy;
struct NonReflectingEnergy;
struct PrescribedReaction;
struct PrescribedWork;
struct SlaveSums;
template <class Law>
struct ContactEnergy;

/// What a sample of the scene sums. A new term has its place here, and its file among those that sample_sums.cpp
/// includes.
using SampleTerms =
    TypeList<LeftSum<2>, LeftSum<9>, LeftSum<13>, ArraySum, BlockTotals, ContactEnergy<LinearPenalty>,
             ContactEnergy<GrowingPenalty>, MultiplierEnergy, SlaveSums, MasterSums, PrescribedWork, PrescribedReaction,
             NonReflectingEnergy, ConnectorEnergy, AmplitudeSum, FacetSum, BeamEnergy, BeamKineticEnergy>;

/// Reductions of a sample. On a GPU its sums, dozens of some hundred items each, are one launch: one after the other
/// they take ten times as long.
class SampleSums : public Reductions {
 public:
  /// @param order see Reductions
  explicit SampleSums(ReductionSpace& space, const ExecutionSpace& order = ExecutionSpace())
      : Reductions(space, order) {}

  /// See Reductions. Nothing that the term reads may change before launch().
  template <class Term, class Use>
  void sum(const Term& term, int count, const Use& use) {
    static_assert(is_listed<Term>(SampleTerms{}), "a term of a sample belongs in SampleTerms");
    if constexpr (on_device)
      joined_.add(type_number<Term>(SampleTerms{}), term, count, queue_sum<Term::values>(teams_of(count), use));
    else
      Reductions::sum(term, count, use);
  }

  /// Launches the sums that wait for it.
  void launch();

  void fetch() {
    launch();
    Reductions::fetch();
    joined_.clear();
  }
  void finish_fetch(const Milestone& fetched) {
    Reductions::finish_fetch(fetched);
    joined_.clear();
  }

 private:
  JoinedSums joined_;
};

/// Sums the process's parts.
/// @param term see sum_by_team(); it gets items' numbers among all
/// @param order in which the launch comes
template <class Term>
void sum_parts(const PartedLists& lists, const Term& term, const ExecutionSpace& order) {
  constexpr int values = Term::values;
  const int parts = lists.whole ? lists.part_count() : static_cast<int>(lists.own_parts.extent(0));
  if (parts == 0) return;
  Kokkos::parallel_for(
      "sum_parts", reduction_teams<Sums<values>>(parts, order),
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
