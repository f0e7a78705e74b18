#pragma once

#include <type_traits>

#include "kernels/contact/contact_normals.hpp"
#include "kernels/contact/contact_track.hpp"
#include "kernels/contact/laws/falling_friction.hpp"
#include "kernels/contact/multiplier_arrays.hpp"
#include "kernels/support/item_lanes.hpp"

namespace railwave {

/// Where nodes go by themselves in the step from t_n: what their velocities and the forces other than a contact's do.
struct FreeMotion {
  NodalAcceleration acceleration;
  double velocity_step;                        ///< s, of NodeAdvance
  double step;                                 ///< s
  Array<const double*> relaxation_mass;        ///< kg, of the dynamic relaxation; empty in a run
  Array<const double* [3]> body_acceleration;  ///< m/s2, of true masses; empty in a run

  /// m/N, movement in the step for a force, but for constraints.
  KOKKOS_INLINE_FUNCTION double compliance(int n) const {
    return step * velocity_step /
           (relaxation_mass.extent(0) != 0 ? relaxation_mass(n) : acceleration.force.nodes.mass(n));
  }

  /// m, movement in the step.
  KOKKOS_INLINE_FUNCTION Vector3 operator()(int n) const {
    const NodeArrays& nodes = acceleration.force.nodes;
    Vector3 force = acceleration.force(n) + nodes.mass(n) * acceleration.gravity;
    if (body_acceleration.extent(0) != 0) force = force + nodes.mass(n) * row(body_acceleration, n);
    return step * row(nodes.velocity, n) + acceleration.constrain(n, compliance(n) * force);
  }
};

inline constexpr double multiplicity_quantum = 1.0 / (1ull << 40);

/// Phases of finding multipliers. Begin and Push need nothing but where the nodes are; PredictFreeNodes comes between
/// them and the sweeps: Correct, and Finish as the last one. On a GPU a multiplier's nodes are shared out among lanes
/// in all but the first.
struct Multiplier {
  struct Begin {};
  struct Push {};
  struct Correct {};
  struct Finish {};
};

/// Contact without penetration: the forward increment Lagrange multiplier method (Carpenter, Taylor and Katona 1991).
/// The forces at t_n are those with which no gap closes further than to zero at t_(n+1), gap + n . movement >= 0 with a
/// pressing force or none; and with which a node that sticks does not move over the master, unless that takes more than
/// friction can give. Every multiplier moves nodes that others move too. They are found by Jacobi's iteration,
/// projected on Coulomb's cone, from the last step's: with a multiplier's own compliance replaced by the sum of what
/// all of them do to its nodes, the iteration contracts on any pair of meshes.
///
/// The residual of a few sweeps is a gap, or a way from where the node stuck. Where g is to become tau g, the sweeps
/// leave g_(n+1) - tau g_n = -B (lambda_n - lambda_(n-1)), B >= 0. Taken back at once (tau = 0), the residual makes
/// energy in all modes with omega dt < pi/3: the force is an integral of the gap, and pushes the way the bodies move.
/// With tau = 1 the sum over the steps is g_(n+1) = -B lambda_n: a spring that loses energy, but never lets the bodies
/// back to where they touched. So a small share 1 - tau is taken back in a step, which only modes with
/// 2 (1 - cos(omega dt)) < 1 - tau gain from, and hardly (docs/contact.md). Forces are summed in whole quanta: a run is
/// bitwise repeatable.
///
/// The last step's multipliers go to the external forces at once, so that what the nodes are predicted to do holds
/// them. A sweep reads the changes that its predecessor has left and adds its own to what the one before that had left,
/// so that nobody reads what others are adding to; the last adds them all to the external forces.
/// @tparam Normals along which they press: see kernels/contact/contact_normals.hpp
template <bool Friction, class Normals = FacetNormals>
struct ContactMultiplier {
  ContactSearch search;
  ContactWindow window;
  ExternalForceSum external;
  Array<const int*> external_row;
  Array<const double* [3][3]> constraints;
  FreeNodeArrays free_nodes;
  MultiplierArrays multipliers;
  FirstTouch first_touch;
  double taken_back;  ///< share of gap and way of a node in contact that a step takes back: 1 - tau
  FallingFriction falling_friction;
  Array<double*> friction_state;  ///< of it, value by value, each by slave node; empty where friction is constant
  int sweep = 0;                  ///< of Correct and Finish, from 1

  /// Nodes farther off, in diagonals of the segment, are not asked for their movement: it would have to be faster than
  /// a hundredth of the fastest wave.
  static constexpr double near_share = 0.01;

  /// @param i of the window's nodes: how many of them are near is known on the device only
  template <class Phase, class Lanes>
  KOKKOS_INLINE_FUNCTION void item(const Phase& phase, const int i, const Lanes& lanes) const {
    if (i < window.near_count(0)) run(phase, window.entries(window.near(i)), lanes);
  }

  /// Locate, project; the last step's force is where the iteration starts.
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Begin& /*phase*/, const WindowEntry& near,
                                  const OneLane& /*lanes*/) const {
    const ContactArrays& contact = search.contact;
    const int s = near.slave;
    const Vector3 slave = row(search.position, near.node);
    const int status = contact.status(s), tracked = contact.tracked(s);
    const bool touched = status != status_apart;
    const SegmentPlace place{contact.place(s, 0), contact.place(s, 1)};
    Projection now = ContactTrack::where(search, slave, tracked, place, touched, near.near);
    if (!touched) first_touch.judge(search, s, near.node, tracked, now);
    now = Normals::turned(search, slave, now);
    FirstTouch::count_from_entry(contact, s, now);
    MultiplierRow& r = multipliers.rows(s);
    if constexpr (Normals::curved)
      if (touched) book_work(s, near.node, tracked, place, row(contact.normal_force, s));
    r.normal = now.normal;
    r.gap = now.gap;
    r.closing = touched || now.gap < 0 ? taken_back * now.gap : now.gap;
    if (now.segment >= 0) {
      contact.tracked(s) = now.segment;
      contact.place(s, 0) = now.place.xi;
      contact.place(s, 1) = now.place.eta;
    }
    const Segment segment = contact.surface(now.segment);
    r.active = now.gap < near_share * norm(search.diagonal(segment)) || (touched && is_distance(now.gap));
    r.moved =
        touched ? first_touch.last.template slid<Normals>(search, near.node, slave, tracked, place, now, r.active != 0)
                : Vector3{{0, 0, 0}};
    r.begun = Vector3{{0, 0, 0}};
    r.slips = 1;
    if constexpr (Friction)
      r.friction = friction(s, touched && r.active != 0, status == status_slips ? r.moved : Vector3{{0, 0, 0}});
    if (r.active == 0) return;

    r.count = 0;
    double until = 0;
    add_node(r, near.node, 1, until);
    for (int k = 0; k < 4; ++k) {
      const double weight = segment_shape(k, now.place.xi, now.place.eta);
      if (segment.node[k] >= 0) {
        add_node(r, segment.node[k], weight, until);
        continue;
      }
      const MouthCorner mouth = contact.mouth_corners(-1 - segment.node[k]);
      double share[MouthCorner::pieces];
      search.shares_of(mouth, share);
      for (int piece = 0; piece < MouthCorner::pieces; ++piece)
        add_node(r, mouth.node[piece], share[piece] * weight, until);
    }
    r.until[r.count - 1] = 1;
    r.way = Vector3{{0, 0, 0}};
    if constexpr (Friction) {
      // Towards where the node stuck, should it have crept from there.
      Vector3 way = status == status_sticks ? row(multipliers.way_since_stuck, s) + r.moved : Vector3{{0, 0, 0}};
      way = way - dot(way, now.normal) * now.normal;
      for (int k = 0; k < 3; ++k) multipliers.way_since_stuck(s, k) = way[k];
      r.way = taken_back * way;
    }
    const double pressing = norm(row(contact.normal_force, s));
    if (touched) {
      r.begun = pressing * now.normal;
      if constexpr (Friction) {
        Vector3 tangential = row(contact.tangential_force, s);
        tangential = tangential - dot(tangential, now.normal) * now.normal;
        r.begun = r.begun + tangential;
      }
    }
    r.swept[0] = {r.begun, {{0, 0, 0}}, pressing};
  }

  KOKKOS_INLINE_FUNCTION static void add_node(MultiplierRow& r, int node, double share, double& until) {
    until += r.count > 0 ? share : 0;
    r.node[r.count] = node;
    r.share[r.count] = share;
    r.until[r.count] = until;
    ++r.count;
  }

  /// The coefficient that bounds the force to be found, by how the node has slid up to now. What one that sticks creeps
  /// in a step is not sliding: it is taken back.
  KOKKOS_INLINE_FUNCTION double friction(int s, bool touched, const Vector3& slid) const {
    if (friction_state.extent(0) == 0) return falling_friction.at_rest;
    double state[FallingFriction::state_values];
    const int slaves = search.contact.slave_count;
    for (int k = 0; k < FallingFriction::state_values; ++k) state[k] = friction_state(k * slaves + s);
    if (touched)
      falling_friction.coefficient({slid, first_touch.last.elapsed}, state);
    else
      falling_friction.forget(state);
    for (int k = 0; k < FallingFriction::state_values; ++k) friction_state(k * slaves + s) = state[k];
    return state[FallingFriction::now];
  }

  /// Lists the nodes that a multiplier pushes, and hands them the last step's force. Who first pushes a node lists it.
  template <class Lanes>
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Push& /*phase*/, const WindowEntry& near,
                                  const Lanes& lanes) const {
    MultiplierRow& r = multipliers.rows(near.slave);
    if (r.active == 0) return;
    const Vector3 quanta = external.in_quanta(r.begun);
    lanes.each(r.count, [&](int k) {
      const int at = external_row(r.node[k]);
      r.row[k] = at;
      hand(r, k, quanta, &external.contact(at, 0), &external.contact(at, 1), &external.contact(at, 2));
      const auto weight = static_cast<std::uint64_t>(std::fabs(r.share[k]) / multiplicity_quantum) + 1;
      if (Kokkos::atomic_fetch_add(&free_nodes.multiplicity(at), weight) != 0) return;
      free_nodes.nodes(at).node = r.node[k];
      free_nodes.listed(Kokkos::atomic_fetch_add(&free_nodes.listed_count(0), 1)) = at;
    });
  }

  /// Adds a node's share of a force on the slave to sums in whole quanta. Equal and opposite to the last bit: the
  /// segment's nodes have what is between two sums of shares, the last of which is the whole.
  KOKKOS_INLINE_FUNCTION void hand(const MultiplierRow& r, int k, const Vector3& quanta, std::uint64_t* x,
                                   std::uint64_t* y, std::uint64_t* z) const {
    FixedForce share = external.fixed(k == 0 ? quanta : r.until[k] * quanta);
    if (k > 0) {
      const FixedForce before = k == 1 ? FixedForce{{0, 0, 0}} : external.fixed(r.until[k - 1] * quanta);
      for (int c = 0; c < 3; ++c) share.quanta[c] = before.quanta[c] - share.quanta[c];
    }
    Kokkos::atomic_add(x, static_cast<std::uint64_t>(share.quanta[0]));
    Kokkos::atomic_add(y, static_cast<std::uint64_t>(share.quanta[1]));
    Kokkos::atomic_add(z, static_cast<std::uint64_t>(share.quanta[2]));
  }

  template <class Lanes>
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Correct& /*phase*/, const WindowEntry& near,
                                  const Lanes& lanes) const {
    MultiplierRow& r = multipliers.rows(near.slave);
    if (r.active == 0) return;
    const Vector3 before = r.swept[(sweep - 1) & 1].change;
    const Swept now = correct(r, lanes);
    const Vector3 quanta = external.in_quanta(before + now.change);
    const int parity = sweep & 1;
    lanes.each(r.count, [&](int k) {
      const int at = r.row[k];
      hand(r, k, quanta, &free_nodes.change(at, parity, 0), &free_nodes.change(at, parity, 1),
           &free_nodes.change(at, parity, 2));
    });
  }

  /// A sweep's new force of one multiplier.
  template <class Lanes>
  KOKKOS_INLINE_FUNCTION Swept correct(MultiplierRow& r, const Lanes& lanes) const {
    const bool first = sweep == 1;
    const Swept before = r.swept[(sweep - 1) & 1];
    const Vector3 normal = r.normal;
    double compliance =
        first ? lanes.sum(r.count, [&](int k) { return std::fabs(r.share[k]) * free_nodes.nodes(r.row[k]).together; })
              : r.compliance;
    const Vector3 moved = lanes.sum_of_vectors(r.count, [&](int k) {
      const double share = k == 0 ? r.share[k] : -r.share[k];
      return share * (first ? free_nodes.nodes(r.row[k]).predicted : movement(r.row[k]));
    });
    const Vector3 moves = (first ? r.way : r.free) + moved;
    const double opening = dot(moves, normal);
    Swept now;
    now.pressing = std::fmax(0.0, before.pressing - (r.closing + opening) / compliance);
    now.force = now.pressing * normal;
    int slips = 1;
    if constexpr (Friction) {
      Vector3 tangential = before.force - before.pressing * normal - (1 / compliance) * (moves - opening * normal);
      const double bound = r.friction * now.pressing, size = norm(tangential);
      slips = size > bound ? 1 : 0;
      if (size > bound) tangential = (bound / size) * tangential;
      now.force = now.force + tangential;
    }
    now.change = now.force - before.force;
    lanes.once([&] {
      r.swept[sweep & 1] = now;
      r.slips = slips;
      if (!first) return;
      r.compliance = compliance;
      r.free = moves;
    });
    return now;
  }

  /// m, of a node for what multipliers have changed by in this step.
  KOKKOS_INLINE_FUNCTION Vector3 movement(int at) const {
    const FreeNode& free = free_nodes.nodes(at);
    Vector3 force;
    for (int c = 0; c < 3; ++c)
      force[c] =
          external.quantum * static_cast<double>(static_cast<long long>(free_nodes.change(at, (sweep - 1) & 1, c)));
    return projected(constraints, free.constraint, free.compliance * force);
  }

  /// The last sweep; leaves forces and status for the next step and for those who read them, and books the work done
  /// since the last.
  template <class Lanes>
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Finish& /*phase*/, const WindowEntry& near,
                                  const Lanes& lanes) const {
    MultiplierRow& r = multipliers.rows(near.slave);
    Swept now{{{0, 0, 0}}, {{0, 0, 0}}, 0};
    if (r.active != 0) {
      now = correct(r, lanes);
      const Vector3 quanta = external.in_quanta(now.force - r.begun);
      lanes.each(r.count, [&](int k) {
        const int at = r.row[k];
        hand(r, k, quanta, &external.contact(at, 0), &external.contact(at, 1), &external.contact(at, 2));
      });
    }
    lanes.once([&] { leave(r, now, near); });
  }

  KOKKOS_INLINE_FUNCTION void leave(const MultiplierRow& r, const Swept& now, const WindowEntry& near) const {
    const ContactArrays& contact = search.contact;
    const int s = near.slave;
    if constexpr (Normals::curved) {
      const SegmentPlace place{contact.place(s, 0), contact.place(s, 1)};
      if (r.active != 0) book_work(s, near.node, contact.tracked(s), place, now.pressing * r.normal);
    } else {
      const double held = norm(row(contact.normal_force, s)), before = contact.gap(s);
      const bool closes = is_distance(before) && is_distance(r.gap);
      if (closes) multipliers.impact_energy(s) -= 0.5 * (held + now.pressing) * (r.gap - before);
    }
    if constexpr (Friction) {
      const Vector3 tangential = now.force - now.pressing * r.normal;
      contact.friction_energy(s) -= 0.5 * dot(row(contact.tangential_force, s) + tangential, r.moved);
      for (int k = 0; k < 3; ++k) contact.tangential_force(s, k) = tangential[k];
    }
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = now.pressing * r.normal[k];
    contact.gap(s) = r.gap;
    contact.status(s) = !(now.pressing > 0) ? status_apart : r.slips != 0 ? status_slips : status_sticks;
  }

  /// Half of what a normal force at one end of the last step does on the bodies in it. Of curved segments the gap does
  /// not tell: they bend with the nodes around them, to which multipliers hand no force.
  KOKKOS_INLINE_FUNCTION void book_work(int s, int node, int tracked, const SegmentPlace& place,
                                        const Vector3& force) const {
    multipliers.impact_energy(s) -= 0.5 * dot(force, first_touch.last.relative_motion(search, node, tracked, place));
  }
};

/// What the nodes that multipliers push do in the step: gathered once, from several places that wait for each other,
/// however many multipliers push a node. Leaves what counts them at zero for the next step.
struct PredictFreeNodes {
  FreeNodeArrays free_nodes;
  FreeMotion motion;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    if (i >= free_nodes.listed_count(0)) return;
    const int at = free_nodes.listed(i);
    FreeNode& free = free_nodes.nodes(at);
    const int n = free.node;
    free.constraint = motion.acceleration.force.nodes.constraint(n);
    free.compliance = motion.compliance(n);
    free.together = free.compliance * multiplicity_quantum * static_cast<double>(free_nodes.multiplicity(at));
    free.predicted = motion(n);
    free_nodes.multiplicity(at) = 0;
    for (int parity = 0; parity < 2; ++parity)
      for (int axis = 0; axis < 3; ++axis) free_nodes.change(at, parity, axis) = 0;
  }
};

/// A phase of several pairs in one launch, over the nodes in their windows.
/// @tparam Pair a ContactMultiplier
template <class Pair, int count>
struct MultiplierPairs {
  Pair pairs[count];

  template <class Phase, class Lanes>
  KOKKOS_INLINE_FUNCTION void item(const Phase& phase, int i, const Lanes& lanes) const {
    if constexpr (std::is_same_v<Phase, Multiplier::Finish>)
      if (i == 0) lanes.once([&] { pairs[0].free_nodes.listed_count(0) = 0; });
    for (const Pair& pair : pairs) {
      if (i >= 0 && i < pair.window.count) pair.item(phase, i, lanes);
      i -= pair.window.count;
    }
  }

  template <class Phase>
  KOKKOS_INLINE_FUNCTION void operator()(const Phase& phase, const int i) const {
    item(phase, i, OneLane{});
  }
};

/// The same in lanes.
template <class Pair, int count>
struct MultiplierPairsInLanes {
  MultiplierPairs<Pair, count> all;

  template <class Phase, class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Phase& phase, const Member& team) const {
    all.item(phase, team.league_rank() * team.team_size() + team.team_rank(), VectorLanes<Member>{team});
  }
};

}  // namespace railwave
