#pragma once

#include "kernels/contact_search.hpp"
#include "kernels/extra_force.hpp"

namespace railwave {

/// Step (d) of the thesis's table 2.1 for one slave node: locate, project, penetrate, push, rub.
/// Normal: penalty f = -l k n (eq. 2.26). Tangential: Coulomb with the stick trial f* = f_T - k de (eqs. 2.28), de the
/// movement of the contact point over the master since the last step. Without friction the tangential part is absent.
template <bool Friction>
struct ContactForce {
  ContactSearch search;
  ContactWindow window;
  ExtraForces extra;
  Array<const int*> extra_row;  ///< by model node

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const ContactArrays& contact = search.contact;
    const int s = window.slaves(i);
    const int node = contact.slave_nodes(s);
    const Vector3 slave = row(search.position, node);
    const int previous = contact.segment(s);

    contact.closest(s) = search.closest_node(slave, contact.closest(s));
    const Projection now = search.locate(slave, contact.closest(s), previous);
    contact.gap(s) = now.segment < 0 ? 1e300 : now.gap;
    if (now.segment < 0 || now.gap >= 0) {
      part(s, previous);
      return;
    }

    const double stiffness = contact.segment_stiffness(now.segment);
    const double pressing = -now.gap * stiffness;
    Vector3 force = pressing * now.normal;
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = force[k];
    int status = status_slips;
    if constexpr (Friction) {
      const Vector3 tangential = rub(s, previous, now, stiffness, contact.friction * pressing, status);
      for (int k = 0; k < 3; ++k) contact.tangential_force(s, k) = tangential[k];
      force = force + tangential;
    }
    contact.segment(s) = now.segment;
    contact.place(s, 0) = now.xi;
    contact.place(s, 1) = now.eta;
    contact.status(s) = status;
    for (int k = 0; k < 3; ++k) extra.force(extra_row(node), k) += force[k];
  }

  KOKKOS_INLINE_FUNCTION void part(int s, int previous) const {
    const ContactArrays& contact = search.contact;
    if constexpr (Friction) {
      if (previous >= 0) {
        const Vector3 held = row(contact.tangential_force, s);
        contact.friction_energy(s) += 0.5 * dot(held, held) / contact.segment_stiffness(previous);
      }
    }
    contact.segment(s) = -1;
    contact.status(s) = status_apart;
    for (int k = 0; k < 3; ++k) {
      contact.normal_force(s, k) = 0;
      contact.tangential_force(s, k) = 0;
    }
  }

  KOKKOS_INLINE_FUNCTION Vector3 rub(int s, int previous, const Projection& now, double stiffness, double bound,
                                     int& status) const {
    const ContactArrays& contact = search.contact;
    Vector3 moved{{0, 0, 0}};
    Vector3 held{{0, 0, 0}};
    if (previous >= 0) {
      Vector3 corner[4];
      search.corners_of(previous, corner);
      moved = now.point - segment_point(corner, contact.place(s, 0), contact.place(s, 1));
      held = row(contact.tangential_force, s);
    }
    Vector3 trial = held - stiffness * moved;
    // The force carried over lies in last step's tangent plane; what has turned out of the present one is dropped.
    trial = trial - dot(trial, now.normal) * now.normal;
    const double size = norm(trial);
    status = size > bound ? status_slips : status_sticks;
    if (size > bound) trial = (bound / size) * trial;
    contact.friction_energy(s) -=
        0.5 * dot(held + trial, moved) + 0.5 * (dot(trial, trial) - dot(held, held)) / stiffness;
    return trial;
  }
};

/// Forces on the master's nodes, eq. 2.27, gathered in fixed order from the slaves that can reach them.
struct ContactGather {
  ContactArrays contact;
  ContactWindow window;
  ExtraForces extra;
  Array<const int*> extra_row;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int m = window.masters(i);
    Vector3 force{{0, 0, 0}};
    for (int c = window.first(i); c < window.first(i + 1); ++c) {
      const int s = window.candidates(c);
      const int segment = contact.segment(s);
      if (segment < 0) continue;
      for (int k = 0; k < 4; ++k)
        if (contact.segments(segment, k) == m) {
          const double share = segment_shape(k, contact.place(s, 0), contact.place(s, 1));
          force = force - share * (row(contact.normal_force, s) + row(contact.tangential_force, s));
        }
    }
    const int r = extra_row(contact.master_nodes(m));
    for (int k = 0; k < 3; ++k) {
      contact.master_force(m, k) = force[k];
      extra.force(r, k) += force[k];
    }
  }
};

}  // namespace railwave
