#pragma once

#include "kernels/contact/contact_track.hpp"
#include "kernels/contact/team_search.hpp"

namespace railwave {

/// When a near node need not be projected at each step until the next check.
struct NearRest {
  int since = 0;     ///< steps since the check
  double spans = 0;  ///< how many spans there are from now until the next check; 0: none rests
  /// Steps between two looks at those that rest: few of a hundred near nodes touch, and to look at one once more costs
  /// as much as to project it some times.
  static constexpr int span = 8;

  /// Whether a node that has rested is looked at. The check has seen one sheet within its way, so that what comes of it
  /// does not depend on boxes, which a checkpoint has not.
  KOKKOS_INLINE_FUNCTION bool wakes() const { return since > 0; }

  /// @param room m, how much nearer the node may come
  /// @param reach m, how much nearer it can come until the next check
  KOKKOS_INLINE_FUNCTION int steps(double room, double reach) const {
    const double left = spans * room;
    return left >= reach ? since + span * static_cast<int>(left / reach) : 0;
  }
};

/// Sorts the slave nodes of the window into near and far; the next check may be many steps later. Each step until then
/// projects the near nodes only. A node is far when its distance from the master is larger than the distance that both
/// can move until the next check: 1.25 times their present speeds times the interval, plus `sudden` for what waves and
/// loads can add. A near one for which a part of that time is as short rests until then. Of nodes that do not touch,
/// those near a segment's box, or all if `thorough`, are projected here; that renews their tracked segment and, outside
/// the body, their gap.
struct FindNearNodes {
  ContactSearch search;
  ContactWindow window;
  Array<const double* [3]> velocity;
  double interval;     ///< s until the next check
  double sudden;       ///< m
  bool first;          ///< no earlier check counts: nodes that penetrate do so from the start, and keep their gap
  bool thorough;       ///< nodes far from all boxes are projected too
  Array<int*> missed;  ///< one value: nodes that came through the surface although the check before found them far
  Array<const double*> counted;  ///< N/m by slave: spring that is counted in the present step; empty: nobody asks
  Array<int*> uncounted;         ///< one value: near nodes whose spring is stiffer
  NearRest rest;

  /// @param by the search, of a thread or a team
  /// @param writes of a team's threads one
  template <class Search>
  KOKKOS_INLINE_FUNCTION void item(const Search& by, const int i, bool writes) const {
    const ContactArrays& contact = search.contact;
    WindowEntry entry = window.entries(i);
    const int s = entry.slave;
    const bool touching = contact.status(s) != status_apart;
    const bool was_projected = entry.projected();
    entry.near = near_one_sheet;
    entry.rests = 0;
    const Vector3 slave = row(search.position, entry.node);
    if (!touching && !thorough && !by.comes_within(slave, 1.25 * interval * norm(row(velocity, entry.node)) + sudden)) {
      entry.near = 0;
    } else if (!touching) {
      double beyond;
      const Projection found = by.nearest(slave, contact.tracked(s), beyond);
      const bool beside = search.beside(found, beyond);
      const bool penetrating = !beside && found.gap < 0;
      const double far = reach(entry.node, found.segment);
      const double tolerance =
          ContactSearch::outside_tolerance * norm(search.diagonal(search.contact.surface(found.segment)));
      const double room = norm(found.offset) - tolerance;
      // The comparisons are false for NaN, so such a node stays near.
      if (!penetrating && room > far)
        entry.near = 0;
      else if (!rest.wakes() && by.several_sheets(slave, found, norm(found.offset) + 2 * far))
        entry.near = near_several_sheets;
      // One beside the surface can come in under it, as far from it as it is, and must be seen beside it a step before;
      // so must one that may be within another sheet's body.
      else if (!beside && found.gap > 0)
        entry.rests = rest.steps(room, far);
      if (!writes) return;
      contact.tracked(s) = found.segment;
      contact.place(s, 0) = found.place.xi;
      contact.place(s, 1) = found.place.eta;
      if (!penetrating) {
        // One that goes on to be projected keeps the gap of the step before, from which its work is counted.
        const bool goes_on = !first && was_projected && entry.projected() && is_distance(contact.gap(s));
        if (!goes_on) contact.gap(s) = beside ? beside_surface : found.gap;
      } else if (first) {
        contact.gap(s) = found.gap;
      } else if (!was_projected) {
        // No step has projected the node since the last check: its depth must show whether it came through the surface.
        // FirstTouch judges nodes that were projected, in the step in which they touch.
        const bool through = -found.gap <= far;
        contact.gap(s) = through ? found.gap : turned_away;
        if (through) Kokkos::atomic_add(&missed(0), 1);
      }
    }
    if (!writes) return;
    window.entries(i) = entry;
    if (entry.near == 0) return;
    if (entry.rests == 0) window.near(Kokkos::atomic_fetch_add(&window.near_count(0), 1)) = i;
    constexpr double rounding = 1e-9;
    if (counted.extent(0) != 0 && contact.segment_stiffness(contact.tracked(s)) > (1 + rounding) * counted(s))
      Kokkos::atomic_add(&uncounted(0), 1);
  }

  /// Distance that slave node and segment together can move until the next check, m.
  KOKKOS_INLINE_FUNCTION double reach(int node, int segment) const {
    const Segment master = search.contact.surface(segment);
    double speed = 0;
    for (int k = 0; k < 4; ++k) speed = std::fmax(speed, norm(search.at_corner(velocity, master.node[k])));
    return 1.25 * interval * (speed + norm(row(velocity, node))) + sudden;
  }
};

/// Looks at nodes that have rested long enough, between two checks.
struct WakeNodes {
  FindNearNodes find;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int rests = find.window.entries(i).rests;
    if (rests > 0 && rests <= find.rest.since) find.item(find.search, i, true);
  }
};

}  // namespace railwave
