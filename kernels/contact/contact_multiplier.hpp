#pragma once

#include <type_traits>

#include "kernels/contact/contact_normals.hpp"
#include "kernels/contact/contact_track.hpp"
#include "kernels/contact/laws/falling_friction.hpp"
#include "kernels/contact/multiplier_arrays.hpp"

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

/// Phases of finding multipliers. Begin needs nothing but where the nodes are; PredictFreeNodes comes between it and
/// the sweeps: Correct, and Finish as the last one.
struct Multiplier {
  struct Begin {};
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
  template <class Phase>
  KOKKOS_INLINE_FUNCTION void item(const Phase& phase, const int i) const {
    if (i < window.near_count(0)) run(phase, window.entries(window.near(i)));
  }

  /// Locate, project; the last step's force is where the iteration starts.
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Begin& /*phase*/, const WindowEntry& near) const {
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
    r.force = r.begun = r.change = Vector3{{0, 0, 0}};
    r.pressing = 0;
    r.slips = 1;
    if constexpr (Friction)
      r.friction = friction(s, touched && r.active != 0, status == status_slips ? r.moved : Vector3{{0, 0, 0}});
    if (r.active == 0) return;

    r.count = 0;
    add_node(r, near.node, 1);
    for (int k = 0; k < 4; ++k) {
      const double weight = -segment_shape(k, now.place.xi, now.place.eta);
      if (segment.node[k] >= 0) {
        add_node(r, segment.node[k], weight);
        continue;
      }
      const MouthCorner mouth = contact.mouth_corners(-1 - segment.node[k]);
      double share[MouthCorner::pieces];
      search.shares_of(mouth, share);
      for (int piece = 0; piece < MouthCorner::pieces; ++piece) add_node(r, mouth.node[piece], share[piece] * weight);
    }
    r.free = Vector3{{0, 0, 0}};
    if constexpr (Friction) {
      // Towards where the node stuck, should it have crept from there.
      Vector3 way = status == status_sticks ? row(multipliers.way_since_stuck, s) + r.moved : Vector3{{0, 0, 0}};
      way = way - dot(way, now.normal) * now.normal;
      for (int k = 0; k < 3; ++k) multipliers.way_since_stuck(s, k) = way[k];
      r.free = taken_back * way;
    }
    r.pressing = norm(row(contact.normal_force, s));
    if (!touched) return;
    r.force = r.pressing * now.normal;
    if constexpr (Friction) {
      Vector3 tangential = row(contact.tangential_force, s);
      tangential = tangential - dot(tangential, now.normal) * now.normal;
      r.force = r.force + tangential;
    }
    r.begun = r.force;
    scatter(r, r.begun, [&](int at, int axis) { return &external.contact(at, axis); });
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

  /// Who first pushes a node lists it.
  KOKKOS_INLINE_FUNCTION void add_node(MultiplierRow& r, int node, double weight) const {
    const int at = external_row(node);
    r.row[r.count] = at;
    r.weight[r.count] = weight;
    ++r.count;
    const auto share = static_cast<std::uint64_t>(std::fabs(weight) / multiplicity_quantum) + 1;
    if (Kokkos::atomic_fetch_add(&free_nodes.multiplicity(at), share) != 0) return;
    free_nodes.nodes(at).node = node;
    free_nodes.listed(Kokkos::atomic_fetch_add(&free_nodes.listed_count(0), 1)) = at;
  }

  /// Hands a force on the slave to its nodes. Equal and opposite to the last bit: the last corner takes what the others
  /// leave.
  /// @param place of a row's sum, by axis
  template <class Place>
  KOKKOS_INLINE_FUNCTION void scatter(const MultiplierRow& r, const Vector3& force, const Place& place) const {
    const Vector3 quanta = external.in_quanta(force);
    const FixedForce whole = external.fixed(quanta);
    FixedForce left = whole;
    for (int c = 0; c < 3; ++c) Kokkos::atomic_add(place(r.row[0], c), static_cast<std::uint64_t>(whole.quanta[c]));
    for (int k = 1; k < r.count; ++k) {
      const FixedForce share = k + 1 < r.count ? external.fixed(-r.weight[k] * quanta) : left;
      for (int c = 0; c < 3; ++c) {
        left.quanta[c] -= share.quanta[c];
        Kokkos::atomic_add(place(r.row[k], c), static_cast<std::uint64_t>(-share.quanta[c]));
      }
    }
  }

  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Correct& /*phase*/, const WindowEntry& near) const {
    MultiplierRow& r = multipliers.rows(near.slave);
    if (r.active == 0) return;
    const Vector3 before = r.change;
    correct(r);
    scatter(r, before + r.change, [&](int at, int axis) { return &free_nodes.change(at, sweep & 1, axis); });
  }

  /// A sweep's new force of one multiplier.
  KOKKOS_INLINE_FUNCTION void correct(MultiplierRow& r) const {
    Vector3 moves = r.free;
    if (sweep == 1) {
      r.compliance = 0;
      for (int k = 0; k < r.count; ++k) {
        const FreeNode& free = free_nodes.nodes(r.row[k]);
        moves = moves + r.weight[k] * free.predicted;
        r.compliance += std::fabs(r.weight[k]) * free.together;
      }
      r.free = moves;
    } else {
      for (int k = 0; k < r.count; ++k) moves = moves + r.weight[k] * movement(r.row[k]);
    }
    const double opening = dot(moves, r.normal);
    const double pressing = std::fmax(0.0, r.pressing - (r.closing + opening) / r.compliance);
    Vector3 force = pressing * r.normal;
    r.slips = 1;
    if constexpr (Friction) {
      Vector3 tangential = r.force - r.pressing * r.normal - (1 / r.compliance) * (moves - opening * r.normal);
      const double bound = r.friction * pressing, size = norm(tangential);
      r.slips = size > bound ? 1 : 0;
      if (size > bound) tangential = (bound / size) * tangential;
      force = force + tangential;
    }
    r.change = force - r.force;
    r.force = force;
    r.pressing = pressing;
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
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Finish& /*phase*/, const WindowEntry& near) const {
    const ContactArrays& contact = search.contact;
    const int s = near.slave;
    MultiplierRow& r = multipliers.rows(s);
    if (r.active != 0) {
      correct(r);
      scatter(r, r.force - r.begun, [&](int at, int axis) { return &external.contact(at, axis); });
    }
    if constexpr (Normals::curved) {
      const SegmentPlace place{contact.place(s, 0), contact.place(s, 1)};
      if (r.active != 0) book_work(s, near.node, contact.tracked(s), place, r.pressing * r.normal);
    } else {
      const double held = norm(row(contact.normal_force, s)), before = contact.gap(s);
      const bool closes = is_distance(before) && is_distance(r.gap);
      if (closes) multipliers.impact_energy(s) -= 0.5 * (held + r.pressing) * (r.gap - before);
    }
    if constexpr (Friction) {
      const Vector3 tangential = r.force - r.pressing * r.normal;
      contact.friction_energy(s) -= 0.5 * dot(row(contact.tangential_force, s) + tangential, r.moved);
      for (int k = 0; k < 3; ++k) contact.tangential_force(s, k) = tangential[k];
    }
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = r.pressing * r.normal[k];
    contact.gap(s) = r.gap;
    contact.status(s) = !(r.pressing > 0) ? status_apart : r.slips != 0 ? status_slips : status_sticks;
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

  template <class Phase>
  KOKKOS_INLINE_FUNCTION void operator()(const Phase& phase, const int i) const {
    int k = i;
    for (const Pair& pair : pairs) {
      if (k >= 0 && k < pair.window.count) pair.item(phase, k);
      k -= pair.window.count;
    }
    if constexpr (std::is_same_v<Phase, Multiplier::Finish>)
      if (i == 0) pairs[0].free_nodes.listed_count(0) = 0;
  }
};

}  // namespace railwave
