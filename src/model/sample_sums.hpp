#pragma once

#include "kernels/support/joined_sums.hpp"
#include "kernels/support/reductions.hpp"

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
  explicit SampleSums(ReductionSpace& space) : Reductions(space) {}

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

}  // namespace railwave
