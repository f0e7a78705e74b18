#pragma once

#include "kernels/contact/contact_search.hpp"
#include "kernels/support/team.hpp"

namespace railwave {

/// A ContactSearch of one slave node by all threads of a team, who open boxes and project on segments side by side. A
/// GPU's thread by itself takes 50 us, as it waits for each load and each result before the next. What is found is the
/// same. All threads of the team call each function with the same arguments, and all have its result.
struct TeamSearch {
  using Member = Team::member_type;

  /// What the threads have in common.
  struct Memory {
    static constexpr int most_boxes = 128;  ///< of a kind that are open
    static constexpr int most_meeting = 16;
    enum Level { boughs, branches, leaves, segments, levels };

    int listed[2][most_boxes];  ///< of the present level and of the one before
    int count[levels];
    int met, nearest;
    double squared;
    NearestPlace place;
    struct Met {
      int box, segment;
      NearestPlace place;
      ContactSearch::MeetingNormal normal;
    } meeting[most_meeting];
  };

  static std::size_t scratch_size() { return sizeof(Memory) + scratch_alignment; }

  const ContactSearch& search;
  const Member& team;
  Memory* memory;

  KOKKOS_INLINE_FUNCTION TeamSearch(const ContactSearch& of, const Member& by)
      : search(of), team(by), memory(reinterpret_cast<Memory*>(scratch_values<char>(by, sizeof(Memory)))) {}

  KOKKOS_INLINE_FUNCTION Projection nearest(const Vector3& slave, int start, double& beyond) const {
    const double limit = ContactSearch::nearest_within(search.see(slave, start)).squared;
    if (!open_boxes(slave, limit)) return search.nearest(slave, start, beyond);
    int mine = start;
    NearestPlace place = NearestPlace::none();
    for_each_open([&](int box) {
      const SeenSegment seen = search.see(slave, search.contact.boxes.order(box));
      NearestPlace found;
      if (!ContactSearch::within(seen, limit, found) || !ContactSearch::nearer(found, seen.segment, place, mine))
        return;
      mine = seen.segment;
      place = found;
    });
    const int best = nearest_of_all(mine, place) ? memory->nearest : start;
    place = memory->place;
    ContactSearch::Meeting meeting;
    if (ContactSearch::at_side(place.place)) {
      meeting.begin(search.see(slave, best), place);
      if (!join(slave, meeting, meeting.limit(place))) return search.nearest(slave, start, beyond);
    }
    return search.concluded(slave, best, place, meeting, beyond);
  }

  KOKKOS_INLINE_FUNCTION Projection locate(const Vector3& slave, int start) const {
    double beyond;
    const Projection found = nearest(slave, start, beyond);
    return search.unless_beside(found, beyond);
  }

  KOKKOS_INLINE_FUNCTION bool comes_within(const Vector3& slave, double distance) const {
    if (!open_boxes(slave, distance * distance)) return search.comes_within(slave, distance);
    return memory->count[Memory::segments] > 0;
  }

  KOKKOS_INLINE_FUNCTION bool several_sheets(const Vector3& slave, const Projection& nearest, double distance) const {
    if (!open_boxes(slave, distance * distance)) return search.several_sheets(slave, nearest, distance);
    const Vector3 normal = search.normal_at(slave, nearest);
    for_each_open([&](int box) {
      if (search.turned_from(normal, box)) Kokkos::atomic_fetch_add(&memory->met, 1);
    });
    team.team_barrier();
    return memory->met > 0;
  }

 private:
  /// Lists all segments whose boxes are within a distance, m2. @return false: they are too many
  KOKKOS_INLINE_FUNCTION bool open_boxes(const Vector3& slave, double squared) const {
    team.team_barrier();
    if (team.team_rank() == 0) {
      for (int& count : memory->count) count = 0;
      memory->met = 0;
      memory->nearest = no_segment;
      memory->squared = NearestPlace::none().squared;
      memory->place = NearestPlace::none();
    }
    team.team_barrier();
    const RoundedPlace place(slave);
    const float limit = RoundedPlace::rounded_up(squared);
    const SegmentBoxes& boxes = search.contact.boxes;
    for (int g = team.team_rank(); g < boxes.bough_count(); g += team.team_size())
      list_if_near(place, limit, boxes.bough, g, Memory::boughs);
    open<SegmentBoxes::bough_size>(place, limit, boxes.branch, Memory::branches);
    open<SegmentBoxes::branch_size>(place, limit, boxes.leaf, Memory::leaves);
    open<SegmentBoxes::leaf_size>(place, limit, boxes.segment, Memory::segments);
    team.team_barrier();
    for (const int count : memory->count)
      if (count > Memory::most_boxes) return false;
    return true;
  }

  /// Lists those of the next level in what is listed.
  template <int of_each>
  KOKKOS_INLINE_FUNCTION void open(const RoundedPlace& place, float limit, const Array<RoundedBox*>& boxes,
                                   int level) const {
    team.team_barrier();
    const int* around = memory->listed[(level - 1) % 2];
    const int count = of_each * listed_count(level - 1), all = static_cast<int>(boxes.extent(0));
    for (int k = team.team_rank(); k < count; k += team.team_size()) {
      const int b = of_each * around[k / of_each] + k % of_each;
      if (b < all) list_if_near(place, limit, boxes, b, level);
    }
  }

  KOKKOS_INLINE_FUNCTION void list_if_near(const RoundedPlace& place, float limit, const Array<RoundedBox*>& boxes,
                                           int b, int level) const {
    if (place.is_beyond(boxes(b), limit)) return;
    const int at = Kokkos::atomic_fetch_add(&memory->count[level], 1);
    if (at < Memory::most_boxes) memory->listed[level % 2][at] = b;
  }

  KOKKOS_INLINE_FUNCTION int listed_count(int level) const {
    return memory->count[level] < Memory::most_boxes ? memory->count[level] : Memory::most_boxes;
  }

  /// Calls visit with the place in the order of each listed segment.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_open(const Visit& visit) const {
    const int count = memory->count[Memory::segments];
    for (int k = team.team_rank(); k < count; k += team.team_size()) visit(memory->listed[Memory::segments % 2][k]);
  }

  /// Leaves the nearest of what the threads have found in memory. @return whether anybody has found any
  KOKKOS_INLINE_FUNCTION bool nearest_of_all(int mine, const NearestPlace& place) const {
    Kokkos::atomic_fetch_min(&memory->squared, place.squared);
    team.team_barrier();
    const bool least = place.squared == memory->squared && place.squared < NearestPlace::none().squared;
    if (least) Kokkos::atomic_fetch_min(&memory->nearest, mine);
    team.team_barrier();
    if (least && mine == memory->nearest) memory->place = place;
    team.team_barrier();
    return memory->nearest != no_segment;
  }

  /// Takes the segments that have a place in common, in the order of their boxes. @return false: they are too many
  KOKKOS_INLINE_FUNCTION bool join(const Vector3& slave, ContactSearch::Meeting& meeting, double limit) const {
    for_each_open([&](int box) {
      const SeenSegment seen = search.see(slave, search.contact.boxes.order(box));
      NearestPlace found;
      if (!ContactSearch::within(seen, limit, found) || !meeting.has(seen, found)) return;
      const int at = Kokkos::atomic_fetch_add(&memory->met, 1);
      if (at < Memory::most_meeting)
        memory->meeting[at] = {box, seen.segment, found, ContactSearch::meeting_normal(seen, found)};
    });
    team.team_barrier();
    const int met = memory->met;
    if (met > Memory::most_meeting) return false;
    for (int taken = 0, last = -1; taken < met; ++taken) {
      int next = -1;
      for (int k = 0; k < met; ++k)
        if (memory->meeting[k].box > last && (next < 0 || memory->meeting[k].box < memory->meeting[next].box)) next = k;
      const Memory::Met& one = memory->meeting[next];
      meeting.take(one.segment, one.place, one.normal);
      last = one.box;
    }
    return true;
  }

  static constexpr int no_segment = 0x7fffffff;
};

/// For kernels that search for one slave node with each item: item(search, i, writes) is called by one thread of a
/// host, and by all threads of a GPU's team, of which one writes.
template <class Kernel>
struct SearchByTeams {
  Kernel kernel;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { kernel.item(kernel.search, i, true); }
  KOKKOS_INLINE_FUNCTION void operator()(const TeamSearch::Member& team) const {
    kernel.item(TeamSearch(kernel.search, team), team.league_rank(), team.team_rank() == 0);
  }
};

/// Of one warp. With fewer registers, so that all of a wheel's have room at a time, they take longer.
inline constexpr int threads_of_search = 32;
using SearchTeams = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<threads_of_search>, AsArgument>;

/// @param threads of a team
inline SearchTeams search_teams(const ExecutionSpace& space, int teams, int threads) {
  SearchTeams policy(space, teams, threads);
  policy.set_scratch_size(0, Kokkos::PerTeam(TeamSearch::scratch_size()));
  return policy;
}

/// @param space in whose order
template <class Kernel>
void search_parallel_for(const ExecutionSpace& space, const char* label, int count, const Kernel& kernel) {
  const SearchByTeams<Kernel> search{kernel};
  if constexpr (on_device)
    Kokkos::parallel_for(label, search_teams(space, count, threads_of_search), search);
  else
    Kokkos::parallel_for(label, SpreadRange(space, 0, count), search);
}

}  // namespace railwave
