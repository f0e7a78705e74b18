#pragma once

#include "kernels/contact_force.hpp"

namespace railwave {

/// Contact by augmented Lagrange while a scene settles, for pairs whose run has multipliers: a node presses with
/// max(0, lambda - k gap), lambda being what it pressed with at the last update, so that k need not be large for the gap to
/// vanish. Friction is that of the penalty springs: a node sticks by a spring to where it touched first.
/// The gap's offset in place of what PlainContactLaw does is all that differs from ContactForce.
template <bool Friction, class Normals>
struct AugmentedContact {
  ContactForce<Friction, PlainContactLaw, Normals> springs;
  Array<const double*> multiplier;  ///< N, by slave node
  double stiffening;                ///< k over the penalty's stiffness

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    if (i >= springs.window.near_count(0)) return;
    const ContactSearch& search = springs.search;
    const ContactArrays& contact = search.contact;
    const WindowEntry entry = springs.window.entries(springs.window.near(i));
    const int s = entry.slave;
    const Vector3 slave = row(search.position, entry.node);
    const bool touched = contact.status(s) != status_apart;
    const int tracked = contact.tracked(s);
    const SegmentPlace place{contact.place(s, 0), contact.place(s, 1)};
    const Projection now = Normals::turned(search, slave, ContactTrack::where(search, slave, tracked, place, touched));
    const int previous = touched ? tracked : -1;
    if (now.segment >= 0) {
      contact.tracked(s) = now.segment;
      contact.place(s, 0) = now.place.xi;
      contact.place(s, 1) = now.place.eta;
    }
    contact.gap(s) = now.gap;
    const double stiffness = now.gap < 1e299 ? stiffening * contact.segment_stiffness(now.segment) : 0.0;
    const double pressing = multiplier(s) - stiffness * now.gap;
    if (stiffness == 0 || !(pressing > 0)) {
      if (touched) springs.part(s, previous);
      return;
    }
    Vector3 force = pressing * now.normal;
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = force[k];
    int status = status_slips;
    if constexpr (Friction) {
      const Vector3 tangential = springs.rub(s, slave, previous, place, now, stiffness, pressing, status);
      for (int k = 0; k < 3; ++k) contact.tangential_force(s, k) = tangential[k];
      force = force + tangential;
    }
    contact.status(s) = status;
    springs.push(entry.node, contact.surface(now.segment), now, force);
  }
};

}  // namespace railwave
