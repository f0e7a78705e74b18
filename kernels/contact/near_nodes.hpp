#pragma once

#include "kernels/contact/contact_track.hpp"

namespace railwave {

/// Finds which slave nodes of the window can touch before the next check, at times many steps apart; and brings the
/// gaps and tracked segments of those near, and at times of all, up to date. A node is far when its distance from the
/// master is larger than what both can move until then: their present speeds and a quarter more, and `sudden` for what
/// waves and loads can add.
struct FindNearNodes {
  ContactSearch search;
  ContactWindow window;
  Array<const double* [3]> velocity;
  double interval;     ///< s until the next check
  double sudden;       ///< m
  bool first;          ///< no check was before: all that penetrates does so from the beginning
  bool thorough;       ///< far nodes are located too
  Array<int*> missed;  ///< one: nodes found penetrating that the check before had called far

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const ContactArrays& contact = search.contact;
    WindowEntry entry = window.entries(i);
    const int s = entry.slave;
    const bool touching = contact.status(s) != status_apart;
    const bool was_near = entry.near != 0;
    entry.near = near_one_sheet;
    const Vector3 slave = row(search.position, entry.node);
    if (!touching && !thorough &&
        !search.comes_within(slave, 1.25 * interval * norm(row(velocity, entry.node)) + sudden)) {
      entry.near = 0;
    } else if (!touching) {
      double beyond;
      const Projection found = search.nearest(slave, contact.tracked(s), beyond);
      contact.tracked(s) = found.segment;
      contact.place(s, 0) = found.place.xi;
      contact.place(s, 1) = found.place.eta;
      const bool beside = search.beside(found, beyond);
      const bool penetrating = !beside && found.gap < 0;
      const double far = reach(entry.node, found.segment);
      if (!penetrating) {
        contact.gap(s) = beside ? beside_surface : found.gap;
      } else if (first) {
        contact.gap(s) = found.gap;
      } else if (!was_near) {
        // Nothing has been checked for as long as an interval. Nodes that were near are judged when they touch.
        const bool through = -found.gap <= far;
        contact.gap(s) = through ? found.gap : turned_away;
        if (through) Kokkos::atomic_add(&missed(0), 1);
      }
      const double tolerance =
          ContactSearch::outside_tolerance * norm(search.diagonal(search.contact.surface(found.segment)));
      // A NaN is near.
      if (!penetrating && norm(found.offset) > far + tolerance)
        entry.near = 0;
      else if (search.several_sheets(slave, found, norm(found.offset) + 2 * far))
        entry.near = near_several_sheets;
    }
    window.entries(i) = entry;
    if (entry.near != 0) window.near(Kokkos::atomic_fetch_add(&window.near_count(0), 1)) = i;
  }

  /// How far slave and segment can move until the next check, m.
  KOKKOS_INLINE_FUNCTION double reach(int node, int segment) const {
    const Segment master = search.contact.surface(segment);
    double speed = 0;
    for (int k = 0; k < 4; ++k) speed = std::fmax(speed, norm(search.at_corner(velocity, master.node[k])));
    return 1.25 * interval * (speed + norm(row(velocity, node))) + sudden;
  }
};

}  // namespace railwave
