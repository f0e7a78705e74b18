#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "kernels/support/team_reduction.hpp"
#include "kernels/support/type_list.hpp"

namespace railwave {

/// One of the sums of a launch.
struct JoinedSum {
  int type;          ///< number of its term's type in the list
  int count;         ///< items
  int first_team;    ///< of those that share the items
  int items;         ///< of a team
  std::size_t term;  ///< bytes before its term
  std::size_t left;  ///< place of its first team's sums, numbers
};

template <class List>
struct SumJoined;

/// Sums over several lists of items by terms of different types: each team takes some items of one list.
template <class... Terms>
struct SumJoined<TypeList<Terms...>> {
  static_assert(sizeof...(Terms) > 0);
  const unsigned char* given;  ///< terms, sums, and the sum of each team, as JoinedSums gives them
  std::size_t sums, of_team;   ///< bytes before these
  double* left;

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int number = reinterpret_cast<const int*>(given + of_team)[team.league_rank()];
    const JoinedSum& sum = reinterpret_cast<const JoinedSum*>(given + sums)[number];
    choose(team, sum, std::index_sequence_for<Terms...>());
  }

 private:
  template <class Member, std::size_t... number>
  KOKKOS_INLINE_FUNCTION void choose(const Member& team, const JoinedSum& sum, std::index_sequence<number...>) const {
    ((sum.type == static_cast<int>(number) ? add<Terms>(team, sum) : void()), ...);
  }

  template <class Term, class Member>
  KOKKOS_INLINE_FUNCTION void add(const Member& team, const JoinedSum& of) const {
    const Term& term = *reinterpret_cast<const Term*>(given + of.term);
    Sums<Term::values>* const result = reinterpret_cast<Sums<Term::values>*>(left + of.left);
    const int part = team.league_rank() - of.first_team, begin = part * of.items;
    const int end = of.count - begin < of.items ? of.count : begin + of.items;
    sum_by_team(team, term, begin, end, result[part]);
  }
};

/// Sums that wait for a launch together. Each term is copied byte by byte, so the arrays that it names must be there
/// until its sum has been fetched.
class JoinedSums {
 public:
  /// @param type number of the term's type in the list of launch()
  /// @param left place of the sums that its teams leave, Term::values numbers each
  template <class Term>
  void add(int type, const Term& term, int count, std::size_t left) {
    static_assert(alignof(Term) <= alignment);
    if (count == 0) return;
    const int number = static_cast<int>(sums_.size()), first_team = static_cast<int>(of_team_.size());
    const std::size_t place = append(static_cast<const void*>(&term), sizeof(Term));
    sums_.push_back({type, count, first_team, items_of_team(count), place, left});
    of_team_.insert(of_team_.end(), teams_of(count), number);
  }

  /// Launches what has been added since the last launch.
  /// @tparam List types of terms
  /// @param space whose `left` gets the sums
  /// @param order in which the launch comes
  template <class List>
  void launch(ReductionSpace& space, const ExecutionSpace& order) {
    if (sums_.empty()) return;
    const std::size_t sums = append(sums_.data(), sums_.size() * sizeof(JoinedSum));
    const std::size_t of_team = append(of_team_.data(), of_team_.size() * sizeof(int));
    copy_to_device(space, order);
    Kokkos::parallel_for("joined_sums",
                         reduction_teams<Sums<most_values(List{})>>(static_cast<int>(of_team_.size()), order),
                         SumJoined<List>{space.terms.data(), sums, of_team, space.left.data()});
    sums_.clear();
    of_team_.clear();
  }

  /// When all that has been launched has been fetched.
  void clear() {
    bytes_.clear();
    copied_ = 0;
  }

 private:
  static constexpr std::size_t alignment = 16;

  template <class... Terms>
  static constexpr int most_values(TypeList<Terms...> /*list*/) {
    return std::max({Terms::values...});
  }

  std::size_t append(const void* what, std::size_t size) {
    const std::size_t place = (bytes_.size() + alignment - 1) / alignment * alignment;
    bytes_.resize(place + size);
    std::memcpy(bytes_.data() + place, what, size);
    return place;
  }

  void copy_to_device(ReductionSpace& space, const ExecutionSpace& order) {
    if (space.terms.extent(0) < bytes_.size()) {
      order.fence();  // what has been launched reads the terms where they are
      space.terms = unset_array<unsigned char*>("terms of sums", 2 * bytes_.size());
      space.terms_given = PinnedArray<unsigned char*>(
          Kokkos::view_alloc(std::string("terms given"), Kokkos::WithoutInitializing), 2 * bytes_.size());
      copied_ = space.terms_there = 0;
    }
    unsigned char* const given = space.terms_given.data();
    // Most samples have the terms of the one before: little of them changes with time.
    const bool there = bytes_.size() <= space.terms_there &&
                       std::memcmp(given + copied_, bytes_.data() + copied_, bytes_.size() - copied_) == 0;
    if (!there) {
      std::memcpy(given + copied_, bytes_.data() + copied_, bytes_.size() - copied_);
      const auto added = Kokkos::make_pair(copied_, bytes_.size());
      Kokkos::deep_copy(order, Kokkos::subview(space.terms, added), Kokkos::subview(space.terms_given, added));
      space.terms_there = std::max(space.terms_there, bytes_.size());
    }
    copied_ = bytes_.size();
  }

  std::vector<JoinedSum> sums_;
  std::vector<int> of_team_;
  std::vector<unsigned char> bytes_;  ///< all since the last clear()
  std::size_t copied_ = 0;            ///< to the device
};

}  // namespace railwave
