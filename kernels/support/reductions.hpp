#pragma once

#include <cstring>
#include <functional>
#include <vector>

#include "kernels/support/block_largest.hpp"
#include "kernels/support/block_sum.hpp"
#include "kernels/support/meanwhile.hpp"
#include "kernels/support/milestone.hpp"
#include "kernels/support/team_reduction.hpp"

namespace railwave {

/// Sums and largest values over many lists, and values of few items, fetched by the host all at once: a copy from a GPU
/// takes as long as several small kernels. Items are taken together in blocks of a size that their number gives,
/// and the few that are left on the host, so a result is bitwise the same on any number of threads.
class Reductions {
 public:
  /// @param order in which its launches come
  explicit Reductions(ReductionSpace& space, const ExecutionSpace& order = ExecutionSpace())
      : space_(space), order_(order) {}

  const ExecutionSpace& order() const { return order_; }

  /// Queues the sum of `term` over `count` items.
  /// @param term see sum_by_team()
  /// @param use use(const double* sum) gets Term::values numbers at the next fetch()
  template <class Term, class Use>
  void sum(const Term& term, int count, Use use) {
    if constexpr (on_device)
      sum_by_teams(term, count, use);
    else
      sum_by_blocks(term, count, use);
  }

  /// The sum of `term`, which has one value, for launches that come later: at a place of the device, to the last bit
  /// what the host would get. Nothing else is queued.
  template <class Term>
  void sum_on_device(const Term& term, int count, double* result) {
    static_assert(Term::values == 1);
    sum(term, count, [](const double*) {});
    const Queued& one = queued_.back();
    Kokkos::parallel_for("sum_of_left", SpreadRange(order_, 0, 1),
                         SumOfLeft{space_.left.data() + one.place, one.parts, result});
    queued_.clear();
    used_ = 0;
  }

  /// Queues the largest of each of the quantities of `term` over `count` items, with the items that have them.
  /// @param term see BlockLargest
  /// @param use use(const Largest<Term::values>&)
  template <class Term, class Use>
  void largest(const Term& term, int count, Use use) {
    using Found = Largest<Term::values>;
    static_assert(sizeof(Found) % sizeof(double) == 0);
    constexpr int words = sizeof(Found) / sizeof(double);
    const int blocks = teams_of(count);
    const std::size_t place = reserve(static_cast<std::size_t>(blocks) * words);
    Found* const left = reinterpret_cast<Found*>(space_.left.data() + place);
    if (blocks > 0)
      Kokkos::parallel_for("block_largest", reduction_teams<Found>(blocks, order_),
                           BlockLargest<Term>{term, count, items_of_team(count), left});
    queued_.push_back({place, blocks, [use](const double* found, int parts) {
                         Found all, part;
                         all.clear();
                         for (int p = 0; p < parts; ++p) {
                           std::memcpy(&part, found + p * words, sizeof(Found));
                           all.join(part);
                         }
                         use(static_cast<const Found&>(all));
                       }});
  }

  /// Queues the values of each of `count` items.
  /// @param term see EachItem
  /// @param use use(const double*) gets Term::values numbers of the first item, then those of the next
  template <class Term, class Use>
  void each(const Term& term, int count, Use use) {
    const std::size_t place = reserve(static_cast<std::size_t>(count) * Term::values);
    double* const values = space_.left.data() + place;
    Kokkos::parallel_for("each_item", SpreadRange(order_, 0, count), EachItem<Term>{term, values});
    queued_.push_back({place, count, [use](const double* found, int /*items*/) { use(found); }});
  }

  /// Waits for what is queued and hands it out in the order of queueing.
  void fetch() {
    copy_to_host();
    wait_for(order_);
    hand_out();
  }

  /// The same in two parts, between which the host may launch what comes next, but no other reductions of this space.
  /// @param fetched is put where the device has brought what is queued
  void start_fetch(Milestone& fetched) {
    copy_to_host();
    fetched.put(order_);
  }
  void finish_fetch(const Milestone& fetched) {
    fetched.wait();
    hand_out();
  }

 protected:
  /// Queues a sum of which `parts` are left, each Values numbers.
  /// @return their place in what is left
  template <int Values, class Use>
  std::size_t queue_sum(int parts, Use use) {
    const std::size_t place = reserve(static_cast<std::size_t>(parts) * Values);
    queued_.push_back({place, parts, [use](const double* left, int of) {
                         double sum[Values] = {};
                         for (int p = 0; p < of; ++p)
                           for (int k = 0; k < Values; ++k) sum[k] += left[p * Values + k];
                         use(static_cast<const double*>(sum));
                       }});
    return place;
  }

  ReductionSpace& space() { return space_; }

 private:
  template <class Term, class Use>
  void sum_by_teams(const Term& term, int count, const Use& use) {
    const int teams = teams_of(count);
    const std::size_t place = queue_sum<Term::values>(teams, use);
    using Found = Sums<Term::values>;
    Found* const left = reinterpret_cast<Found*>(space_.left.data() + place);
    if (teams > 0)
      Kokkos::parallel_for("team_sum", reduction_teams<Found>(teams, order_),
                           TeamSum<Term>{term, count, items_of_team(count), left});
  }

  template <class Term, class Use>
  void sum_by_blocks(const Term& term, int count, const Use& use) {
    const auto blocks_of = [](int items) { return (items + sum_block - 1) / sum_block; };
    const int blocks = blocks_of(count);
    const bool twice = blocks > sum_block;
    const int parts = twice ? blocks_of(blocks) : blocks;
    const std::size_t place = queue_sum<Term::values>(parts, use);
    double* const left = space_.left.data() + place;
    if (twice) {
      const std::size_t needed = static_cast<std::size_t>(blocks) * Term::values;
      if (space_.blocks.extent(0) < needed) space_.blocks = unset_array<double*>("blocks of reductions", needed);
      double* const first = space_.blocks.data();
      Kokkos::parallel_for("sum_blocks", SpreadRange(order_, 0, blocks), BlockSum<Term>{term, count, first});
      Kokkos::parallel_for("sum_left", SpreadRange(order_, 0, parts),
                           BlockSum<LeftSum<Term::values>>{{first}, blocks, left});
    } else if (blocks > 0) {
      Kokkos::parallel_for("sum_blocks", SpreadRange(order_, 0, blocks), BlockSum<Term>{term, count, left});
    }
  }

  void copy_to_host() {
    if (space_.fetched.extent(0) < used_)
      space_.fetched = PinnedArray<double*>(Kokkos::view_alloc(std::string("fetched"), Kokkos::WithoutInitializing),
                                            space_.left.extent(0));
    const auto used = Kokkos::make_pair(std::size_t{0}, used_);
    if (used_ > 0) Kokkos::deep_copy(order_, Kokkos::subview(space_.fetched, used), Kokkos::subview(space_.left, used));
  }

  void hand_out() {
    for (const Queued& one : queued_) one.use(space_.fetched.data() + one.place, one.parts);
    queued_.clear();
    used_ = 0;
  }

  struct Queued {
    std::size_t place;
    int parts;
    std::function<void(const double*, int)> use;
  };

  /// @return the place in what is left
  std::size_t reserve(std::size_t words) {
    if (space_.left.extent(0) < used_ + words) {
      const auto more = unset_array<double*>("left of reductions", 2 * (used_ + words));
      const auto used = Kokkos::make_pair(std::size_t{0}, used_);
      if (used_ > 0) Kokkos::deep_copy(order_, Kokkos::subview(more, used), Kokkos::subview(space_.left, used));
      space_.left = more;
    }
    const std::size_t place = used_;
    used_ += words;
    return place;
  }

  ReductionSpace& space_;
  const ExecutionSpace order_;
  std::size_t used_ = 0;
  std::vector<Queued> queued_;
};

/// The sum of `term` over `count` items, at once.
/// @param result Term::values numbers
template <class Term>
void block_sum(const Term& term, int count, double* result, ReductionSpace& space) {
  Reductions reductions(space);
  reductions.sum(term, count, [result](const double* sum) { std::memcpy(result, sum, Term::values * sizeof(double)); });
  reductions.fetch();
}

}  // namespace railwave
