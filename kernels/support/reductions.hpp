#pragma once

#include <cstring>
#include <functional>
#include <vector>

#include "kernels/support/block_largest.hpp"
#include "kernels/support/block_sum.hpp"
#include "kernels/support/milestone.hpp"
#include "kernels/support/reduction_space.hpp"

namespace railwave {

/// Sums and largest values over many lists, and values of few items, fetched by the host all at once: a copy from a GPU
/// takes as long as several small kernels. Items are taken together in blocks of fixed size, the blocks in blocks
/// again, and the few that are left on the host, so a result is bitwise the same on any number of threads.
class Reductions {
 public:
  explicit Reductions(ReductionSpace& space) : space_(space) {}

  /// Queues the sum of `term` over `count` items.
  /// @param term see BlockSum
  /// @param use use(const double* sum) gets Term::values numbers at the next fetch()
  template <class Term, class Use>
  void sum(const Term& term, int count, Use use) {
    const auto add_left = [use](const double* left, int parts) {
      double sum[Term::values] = {};
      for (int p = 0; p < parts; ++p)
        for (int k = 0; k < Term::values; ++k) sum[k] += left[p * Term::values + k];
      use(static_cast<const double*>(sum));
    };
    reduce<BlockSum<Term>, BlockSum<LeftSum<Term::values>>, double>(term, count, Term::values, add_left);
  }

  /// Queues the largest of each of the quantities of `term` over `count` items, with the items that have them.
  /// @param term see BlockLargest
  /// @param use use(const Largest<Term::values>&)
  template <class Term, class Use>
  void largest(const Term& term, int count, Use use) {
    using Found = Largest<Term::values>;
    static_assert(sizeof(Found) % sizeof(double) == 0);
    constexpr int words = sizeof(Found) / sizeof(double);
    reduce<BlockLargest<Term>, LeftLargest<Term::values>, Found>(
        term, count, words, [use](const double* left, int parts) {
          Found all, part;
          all.clear();
          for (int p = 0; p < parts; ++p) {
            std::memcpy(&part, left + p * words, sizeof(Found));
            for (int k = 0; k < Term::values; ++k) all.add(k, part.value[k], part.place[k]);
          }
          use(static_cast<const Found&>(all));
        });
  }

  /// Queues the values of each of `count` items.
  /// @param term see EachItem
  /// @param use use(const double*) gets Term::values numbers of the first item, then those of the next
  template <class Term, class Use>
  void each(const Term& term, int count, Use use) {
    const std::size_t place = used_;
    double* const values = reserve(static_cast<std::size_t>(count) * Term::values);
    Kokkos::parallel_for("each_item", SpreadRange(0, count), EachItem<Term>{term, values});
    queued_.push_back({place, count, [use](const double* found, int /*items*/) { use(found); }});
  }

  /// Waits for what is queued and hands it out in the order of queueing.
  void fetch() {
    copy_to_host();
    ExecutionSpace().fence();
    hand_out();
  }

  /// The same in two parts, between which the host may launch what comes next, but no other reductions of this space.
  /// @param fetched is put where the device has brought what is queued
  void start_fetch(Milestone& fetched) {
    copy_to_host();
    fetched.put(ExecutionSpace());
  }
  void finish_fetch(const Milestone& fetched) {
    fetched.wait();
    hand_out();
  }

 private:
  void copy_to_host() {
    if (space_.fetched.extent(0) < used_)
      space_.fetched = PinnedArray<double*>(Kokkos::view_alloc(std::string("fetched"), Kokkos::WithoutInitializing),
                                            space_.left.extent(0));
    const auto used = Kokkos::make_pair(std::size_t{0}, used_);
    if (used_ > 0)
      Kokkos::deep_copy(ExecutionSpace(), Kokkos::subview(space_.fetched, used), Kokkos::subview(space_.left, used));
  }

  void hand_out() {
    for (const Queued& one : queued_) one.use(space_.fetched.data() + one.place, one.parts);
    queued_.clear();
    used_ = 0;
  }

  /// Blocks whose results the host takes as they are: a second kernel takes a GPU longer than copying some more.
  static constexpr int most_left = on_device ? 1024 : sum_block;

  struct Queued {
    std::size_t place;
    int parts;
    std::function<void(const double*, int)> use;
  };

  template <class First, class Second, class Value, class Term, class Use>
  void reduce(const Term& term, int count, int words, Use use) {
    const int blocks = (count + items_of_block - 1) / items_of_block;
    const bool twice = blocks > most_left;
    const int parts = twice ? (blocks + sum_block - 1) / sum_block : blocks;
    const std::size_t place = used_;
    Value* const left = reinterpret_cast<Value*>(reserve(static_cast<std::size_t>(parts) * words));
    if (twice) {
      const std::size_t needed = static_cast<std::size_t>(blocks) * words;
      if (space_.blocks.extent(0) < needed) space_.blocks = unset_array<double*>("blocks of reductions", needed);
      Value* const first = reinterpret_cast<Value*>(space_.blocks.data());
      Kokkos::parallel_for("reduce_blocks", SpreadRange(0, blocks), First{term, count, blocks, first});
      Kokkos::parallel_for("reduce_left", SpreadRange(0, parts), Second{{first}, blocks, parts, left});
    } else if (blocks > 0) {
      Kokkos::parallel_for("reduce_blocks", SpreadRange(0, blocks), First{term, count, blocks, left});
    }
    queued_.push_back({place, parts, std::move(use)});
  }

  double* reserve(std::size_t words) {
    if (space_.left.extent(0) < used_ + words) {
      const auto more = unset_array<double*>("left of reductions", 2 * (used_ + words));
      const auto used = Kokkos::make_pair(std::size_t{0}, used_);
      if (used_ > 0)
        Kokkos::deep_copy(ExecutionSpace(), Kokkos::subview(more, used), Kokkos::subview(space_.left, used));
      space_.left = more;
    }
    double* const place = space_.left.data() + used_;
    used_ += words;
    return place;
  }

  ReductionSpace& space_;
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
