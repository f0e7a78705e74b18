#pragma once

#include "kernels/contact/contact_normals.hpp"
#include "kernels/contact/contact_track.hpp"
#include "kernels/contact/law_at_nodes.hpp"
#include "kernels/contact/laws/linear_penalty.hpp"
#include "kernels/nodes/external_force.hpp"

namespace railwave {

/// Takes reactions from the master's nodes.
struct MasterReaction {
  ContactProjection surface;
  ExternalForceSum external;
  Array<const int*> external_row;  ///< by model node

  /// At a mouth's corner both lips have a share. Equal and opposite to the last bit: this lip takes what the other
  /// leaves.
  KOKKOS_INLINE_FUNCTION void subtract(int corner, const FixedForce& reaction) const {
    if (corner >= 0) return external.subtract(external_row(corner), reaction);
    const MouthCorner mouth = surface.contact.mouth_corners(-1 - corner);
    double share[MouthCorner::pieces];
    surface.shares_of(mouth, share);
    const Vector3 quanta{{static_cast<double>(reaction.quanta[0]), static_cast<double>(reaction.quanta[1]),
                          static_cast<double>(reaction.quanta[2])}};
    FixedForce left = reaction;
    for (int piece = 1; piece < MouthCorner::pieces; ++piece) {
      const FixedForce part = external.fixed(share[piece] * quanta);
      for (int c = 0; c < 3; ++c) left.quanta[c] -= part.quanta[c];
      external.subtract(external_row(mouth.node[piece]), part);
    }
    external.subtract(external_row(mouth.node[0]), left);
  }
};

/// Takes a force's shares from the master's nodes, see SmoothNormals::reaction. Equal and opposite to the last bit.
struct CurvedReaction : MasterReaction {
  Segment segment;
  Vector3 force;  ///< N on the slave

  KOKKOS_INLINE_FUNCTION CurvedReaction(const MasterReaction& reaction, const Segment& of, const Vector3& on_slave)
      : MasterReaction(reaction), segment(of), force(on_slave) {}

  KOKKOS_INLINE_FUNCTION void corners(const Vector3 (&share)[4]) const {
    FixedForce left = external.fixed(external.in_quanta(force));
    for (int k = 0; k < 4; ++k) {
      const FixedForce part = k < 3 ? external.fixed(external.in_quanta(share[k])) : left;
      for (int c = 0; c < 3; ++c) left.quanta[c] -= part.quanta[c];
      subtract(segment.node[k], part);
    }
  }
  KOKKOS_INLINE_FUNCTION void pair(int plus, int minus, const Vector3& share) const {
    const FixedForce part = external.fixed(external.in_quanta(share));
    subtract(plus, part);
    subtract(minus, {{-part.quanta[0], -part.quanta[1], -part.quanta[2]}});
  }
};

/// Step (d) of the thesis's table 2.1 for one slave node: locate, project, penetration, normal force, friction.
/// Normal: penalty f = -l k n (eq. 2.26). Tangential: Coulomb with the stick trial f* = f_T - k de (eqs. 2.28), de the
/// movement of the contact point over the master since the last step. Without friction the tangential part is absent.
/// The force goes to the slave's node and, by the shape functions, to the segment's (eq. 2.27); of curved segments by
/// what each node does to the contact point.
/// @tparam Law what presses and what bounds friction: see kernels/contact/laws/contact_point.hpp
/// @tparam Normals along which it presses: see kernels/contact/contact_normals.hpp
template <bool Friction, class Law = LinearPenalty, class Normals = FacetNormals>
struct ContactForce {
  ContactSearch search;
  ContactWindow window;
  ExternalForceSum external;
  Array<const int*> external_row;  ///< by model node
  FirstTouch first_touch;
  LawAtNodes<Law, Normals> law;

  /// The i-th of the nodes that can touch, if they are so many.
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    if (i >= window.near_count(0)) return;
    const ContactArrays& contact = search.contact;
    const WindowEntry entry = window.entries(window.near(i));
    const int s = entry.slave;
    const Vector3 slave = row(search.position, entry.node);
    const bool touched = contact.status(s) != status_apart;
    const int tracked = contact.tracked(s);
    const SegmentPlace place{contact.place(s, 0), contact.place(s, 1)};

    Projection now = ContactTrack::where(search, slave, tracked, place, touched, entry.near);
    if (!touched) first_touch.judge(search, s, entry.node, tracked, now);
    now = Normals::turned(search, slave, now);
    FirstTouch::count_from_entry(contact, s, now);
    const int previous = touched ? tracked : -1;
    if (now.segment >= 0) {
      contact.tracked(s) = now.segment;
      contact.place(s, 0) = now.place.xi;
      contact.place(s, 1) = now.place.eta;
    }
    contact.gap(s) = now.gap;
    LawState<Law> state = law.state_of(search, s);
    if (!law.touches(search, now, state)) {
      if (touched) {
        part(s, entry.node, slave, previous, place, now);
        law.part(search, first_touch.last, entry.node, now, state);
        law.keep(search, s, state);
      }
      return;
    }

    const double stiffness = law.stiffness(search, now.segment);
    const double pressing = law.pressing(search, first_touch.last, entry.node, now, stiffness, state);
    Vector3 force = pressing * now.normal;
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = force[k];
    int status = status_slips;
    if constexpr (Friction) {
      const Vector3 tangential =
          friction_force(s, entry.node, slave, previous, place, now, stiffness, pressing, state, status);
      for (int k = 0; k < 3; ++k) contact.tangential_force(s, k) = tangential[k];
      force = force + tangential;
    }
    law.keep(search, s, state);
    contact.status(s) = status;
    if constexpr (Normals::curved)
      scatter_curved(entry.node, now, force);
    else
      scatter(entry.node, contact.surface(now.segment), now, force);
  }

  /// What the spring still held is lost, but for what it has worked in the step that ends in no contact.
  KOKKOS_INLINE_FUNCTION void part(int s, int node, const Vector3& slave, int previous, const SegmentPlace& place,
                                   const Projection& now) const {
    const ContactArrays& contact = search.contact;
    if constexpr (Friction) {
      const Vector3 held = row(contact.tangential_force, s),
                    moved = first_touch.last.template slid<Normals>(search, node, slave, previous, place, now, false);
      contact.friction_energy(s) +=
          0.5 * dot(held, held) / contact.segment_stiffness(previous) - 0.5 * dot(held, moved);
    }
    contact.status(s) = status_apart;
    for (int k = 0; k < 3; ++k) {
      contact.normal_force(s, k) = 0;
      contact.tangential_force(s, k) = 0;
    }
  }

  KOKKOS_INLINE_FUNCTION Vector3 friction_force(int s, int node, const Vector3& slave, int previous,
                                                const SegmentPlace& place, const Projection& now, double stiffness,
                                                double pressing, LawState<Law>& state, int& status) const {
    const ContactArrays& contact = search.contact;
    Vector3 moved{{0, 0, 0}};
    Vector3 held{{0, 0, 0}};
    if (previous >= 0) {
      moved = first_touch.last.template slid<Normals>(search, node, slave, previous, place, now, true);
      held = row(contact.tangential_force, s);
    }
    Vector3 trial = held - stiffness * moved;
    // The force carried over lies in last step's tangent plane; what has turned out of the present one is dropped.
    trial = trial - dot(trial, now.normal) * now.normal;
    const double size = norm(trial), pressed = std::fmax(0.0, pressing),
                 held_until = law.friction_before(state) * pressed;
    // What the spring is stretched by is no sliding.
    Vector3 slid{{0, 0, 0}};
    if (size > held_until) slid = ((held_until / size - 1) / stiffness) * trial;
    const double bound = law.friction(first_touch.last, slid, state) * pressed;
    status = size > bound ? status_slips : status_sticks;
    if (size > bound) trial = (bound / size) * trial;
    contact.friction_energy(s) -=
        0.5 * dot(held + trial, moved) + 0.5 * (dot(trial, trial) - dot(held, held)) / stiffness;
    return trial;
  }

  /// Equal and opposite to the last bit: the last corner takes what the others leave. The rows are fetched before the
  /// first addition, for no load moves past an atomic operation and each would wait for memory by itself.
  KOKKOS_INLINE_FUNCTION void scatter(int node, const Segment& segment, const Projection& now,
                                      const Vector3& force) const {
    const int slave_row = external_row(node);
    int master_row[4];
    bool at_mouth = false;
    for (int k = 0; k < 4; ++k) {
      at_mouth = at_mouth || segment.node[k] < 0;
      master_row[k] = segment.node[k] < 0 ? -1 : external_row(segment.node[k]);
    }
    const Vector3 quanta = external.in_quanta(force);
    const FixedForce whole = external.fixed(quanta);
    FixedForce reaction[4], left = whole;
    for (int k = 0; k < 4; ++k) {
      reaction[k] = k < 3 ? external.fixed(segment_shape(k, now.place.xi, now.place.eta) * quanta) : left;
      for (int c = 0; c < 3; ++c) left.quanta[c] -= reaction[k].quanta[c];
    }
    external.add(slave_row, whole);
    for (int k = 0; k < 4; ++k)
      if (master_row[k] >= 0) external.subtract(master_row[k], reaction[k]);
    if (at_mouth)
      for (int k = 0; k < 4; ++k)
        if (segment.node[k] < 0) MasterReaction{search, external, external_row}.subtract(segment.node[k], reaction[k]);
  }

  /// The same on a curved master, where nodes around the segment feel the force too.
  KOKKOS_INLINE_FUNCTION void scatter_curved(int node, const Projection& now, const Vector3& force) const {
    const Segment segment = search.contact.surface(now.segment);
    external.add(external_row(node), external.fixed(external.in_quanta(force)));
    Normals::reaction(search, now.segment, now.place, force,
                      CurvedReaction({search, external, external_row}, segment, force));
  }
};

}  // namespace railwave
