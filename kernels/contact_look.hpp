#pragma once

#include "kernels/contact_track.hpp"

namespace railwave {

/// Finds which slave nodes of the window can touch before the next look, at times many steps apart; and brings every
/// node's gap and tracked segment up to date. A node is far when its distance from the master is larger than what both can
/// move until then: their present speeds and a quarter more, and `sudden` for what waves and loads can add.
struct ContactLook {
  ContactSearch search;
  ContactWindow window;
  Array<const double* [3]> velocity;
  double interval;      ///< s until the next look
  double sudden;        ///< m
  Array<int*> missed;   ///< one: nodes found penetrating that the look before had called far

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const ContactArrays& contact = search.contact;
    WindowEntry entry = window.entries(i);
    const int s = entry.slave;
    const bool touching = contact.status(s) != status_apart;
    const bool was_near = entry.near != 0;
    entry.near = 1;
    if (!touching) {
      const Vector3 slave = row(search.position, entry.node);
      double beyond;
      const Projection found = where(slave, s, beyond);
      contact.tracked(s) = found.segment;
      contact.place(s, 0) = found.place.xi;
      contact.place(s, 1) = found.place.eta;
      const bool beside = search.beside(found, beyond);
      contact.gap(s) = beside ? 1e300 : found.gap;
      const bool penetrating = !beside && found.gap < 0;
      // A NaN is near.
      if (!penetrating && norm(found.offset) > reach(entry.node, found.segment)) entry.near = 0;
      if (penetrating && !was_near) Kokkos::atomic_add(&missed(0), 1);
    }
    window.entries(i) = entry;
    if (entry.near != 0) window.near(Kokkos::atomic_fetch_add(&window.near_count(0), 1)) = i;
  }

  /// The fast way for the many that it is sure of.
  KOKKOS_INLINE_FUNCTION Projection where(const Vector3& slave, int s, double& beyond) const {
    const ContactArrays& contact = search.contact;
    Projection now{};
    now.segment = contact.tracked(s);
    now.place = {contact.place(s, 0), contact.place(s, 1)};
    const int start = search.corner_at(now.segment, now.place);
    if (ContactTrack::follow(search, slave, now, beyond) != ContactTrack::unknown) return now;
    return search.nearest(slave, search.closest_node(slave, start), -1, beyond);
  }

  /// How far slave and segment can move, m, and how far beside a segment a node still counts as over it.
  KOKKOS_INLINE_FUNCTION double reach(int node, int segment) const {
    const Segment master = search.contact.surface(segment);
    double speed = 0;
    for (int k = 0; k < 4; ++k) speed = std::fmax(speed, norm(row(velocity, master.node[k])));
    const Vector3 diagonal = row(search.position, master.node[2]) - row(search.position, master.node[0]);
    return 1.25 * interval * (speed + norm(row(velocity, node))) + sudden +
           ContactSearch::outside_tolerance * norm(diagonal);
  }
};

}  // namespace railwave
