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
  /// @param at its row of external forces
  KOKKOS_INLINE_FUNCTION Vector3 operator()(const SharedNode& shared, int at) const {
    const NodalForce& forces = acceleration.force;
    const NodeArrays& nodes = forces.nodes;
    const int n = shared.node & ~special_bit;
    const auto first = forces.first_rows(shared);
    Vector3 force = forces.with_rows(forces.external.force(at), shared, first) + nodes.mass(n) * acceleration.gravity;
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

  /// Nodes farther off, in diagonals of the segment, are not asked for their movement: it would have to be faster than
  /// a hundredth of the fastest wave.
  static constexpr double near_share = 0.01;

  /// @param i of the window's nodes: how many of them are near is known on the device only
  /// @param sweep of Correct and Finish, from 1
  template <class Phase>
  KOKKOS_INLINE_FUNCTION void item(const Phase& phase, const int i, int sweep) const {
    if (i < window.near_count(0)) run(phase, i, sweep);
  }

  /// What every multiplier has of its row's nodes, in registers: memory is asked for all at once, and not for one after
  /// the other between writes that might have changed it. Where a row has more, they follow in memory.
  struct RowNodes {
    int count, row[nodes_of_multiplier];
    double weight[nodes_of_multiplier];
  };

  KOKKOS_INLINE_FUNCTION static RowNodes nodes_of(const MultiplierRow& r) {
    RowNodes nodes;
    nodes.count = r.count;
    for (int k = 0; k < nodes_of_multiplier; ++k) {
      nodes.row[k] = r.row[k];
      nodes.weight[k] = r.weight[k];
    }
    return nodes;
  }

  /// Locate, project; the last step's force is where the iteration starts.
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Begin& /*phase*/, const int i, int /*sweep*/) const {
    const WindowEntry near = window.entries(window.near(i));
    const ContactArrays& contact = search.contact;
    const int s = near.slave;
    const Vector3 slave = row(search.position, near.node);
    const Vector3 pressed = row(contact.normal_force, s), rubbed = row(contact.tangential_force, s);
    const int status = contact.status(s), tracked = contact.tracked(s);
    const bool touched = status != status_apart;
    const SegmentPlace place{contact.place(s, 0), contact.place(s, 1)};
    Projection now = ContactTrack::where(search, slave, tracked, place, touched, near.near);
    if (!touched) first_touch.judge(search, s, near.node, tracked, now);
    now = Normals::turned(search, slave, now);
    FirstTouch::count_from_entry(contact, s, now);
    if constexpr (Normals::curved)
      if (touched) book_work(s, near.node, tracked, place, pressed);
    if (now.segment >= 0) {
      contact.tracked(s) = now.segment;
      contact.place(s, 0) = now.place.xi;
      contact.place(s, 1) = now.place.eta;
    }
    MultiplierRow& r = multipliers.rows(i);
    r.slave = s;
    r.node = near.node;
    const Segment segment = contact.surface(now.segment);
    const bool active = now.gap < near_share * norm(search.diagonal(segment)) || (touched && is_distance(now.gap));
    const Vector3 moved =
        touched ? first_touch.last.template slid<Normals>(search, near.node, slave, tracked, place, now, active)
                : Vector3{{0, 0, 0}};
    r.normal = now.normal;
    r.gap = now.gap;
    r.closing = touched || now.gap < 0 ? taken_back * now.gap : now.gap;
    r.moved = moved;
    r.active = active ? 1 : 0;
    r.change = Vector3{{0, 0, 0}};
    r.slips = 1;
    if constexpr (Friction)
      r.friction = friction(s, touched && active, status == status_slips ? moved : Vector3{{0, 0, 0}});
    if (!active) {
      r.force = r.begun = Vector3{{0, 0, 0}};
      r.pressing = 0;
      return;
    }
    const RowNodes nodes = list_nodes(r, near.node, segment, now.place);
    r.free = Vector3{{0, 0, 0}};
    if constexpr (Friction) {
      // Towards where the node stuck, should it have crept from there.
      Vector3 way = status == status_sticks ? row(multipliers.way_since_stuck, s) + moved : Vector3{{0, 0, 0}};
      way = way - dot(way, now.normal) * now.normal;
      for (int k = 0; k < 3; ++k) multipliers.way_since_stuck(s, k) = way[k];
      r.free = taken_back * way;
    }
    const double pressing = norm(pressed);
    Vector3 force{{0, 0, 0}};
    if (touched) {
      force = pressing * now.normal;
      if constexpr (Friction) force = force + (rubbed - dot(rubbed, now.normal) * now.normal);
    }
    r.pressing = pressing;
    r.force = r.begun = force;
    if (touched) scatter(r, nodes, force, [&](int at, int axis) { return &external.contact(at, axis); });
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

  /// Writes a multiplier's nodes into its row: the slave's, one of each corner of the segment, then what corners at
  /// mouths have besides.
  KOKKOS_INLINE_FUNCTION RowNodes list_nodes(MultiplierRow& r, int slave, const Segment& segment,
                                             const SegmentPlace& place) const {
    RowNodes nodes;
    nodes.count = nodes_of_multiplier;
    int node[nodes_of_multiplier];
    node[0] = slave;
    nodes.weight[0] = 1;
    for (int k = 0; k < 4; ++k) {
      node[k + 1] = segment.node[k];
      nodes.weight[k + 1] = -segment_shape(k, place.xi, place.eta);
      if (segment.node[k] >= 0) continue;
      const MouthCorner mouth = search.contact.mouth_corners(-1 - segment.node[k]);
      double share[MouthCorner::pieces];
      search.shares_of(mouth, share);
      for (int piece = 1; piece < MouthCorner::pieces; ++piece) {
        const int at = external_row(mouth.node[piece]);
        const double weight = share[piece] * nodes.weight[k + 1];
        r.row[nodes.count] = at;
        r.weight[nodes.count] = weight;
        ++nodes.count;
        count_and_list<1>(&at, &weight);
      }
      node[k + 1] = mouth.node[0];
      nodes.weight[k + 1] *= share[0];
    }
    for (int k = 0; k < nodes_of_multiplier; ++k) nodes.row[k] = external_row(node[k]);
    count_and_list<nodes_of_multiplier>(nodes.row, nodes.weight);
    r.count = nodes.count;
    for (int k = 0; k < nodes_of_multiplier; ++k) {
      r.row[k] = nodes.row[k];
      r.weight[k] = nodes.weight[k];
    }
    return nodes;
  }

  /// Counts a multiplier at a node. @return whether it is the first to push it in this step
  KOKKOS_INLINE_FUNCTION bool count_at(int at, double weight) const {
    const auto share = static_cast<std::uint64_t>(std::fabs(weight) / multiplicity_quantum) + 1;
    return Kokkos::atomic_fetch_add(&free_nodes.multiplicity(at), share) == 0;
  }

  /// Who first pushes nodes lists them.
  template <int count>
  KOKKOS_INLINE_FUNCTION void count_and_list(const int* at, const double* weight) const {
    bool first[count];
    int firsts = 0;
    for (int k = 0; k < count; ++k) first[k] = count_at(at[k], weight[k]);
    for (int k = 0; k < count; ++k) firsts += first[k] ? 1 : 0;
    if (firsts == 0) return;
    int place = Kokkos::atomic_fetch_add(&free_nodes.listed_count(0), firsts);
    for (int k = 0; k < count; ++k) {
      if (!first[k]) continue;
      free_nodes.listed(place++) = at[k];
    }
  }

  /// Hands a force on the slave to its nodes. Equal and opposite to the last bit: the last node takes what the others
  /// leave.
  /// @param place of a row's sum, by axis
  template <class Place>
  KOKKOS_INLINE_FUNCTION void scatter(const MultiplierRow& r, const RowNodes& nodes, const Vector3& force,
                                      const Place& place) const {
    const Vector3 quanta = external.in_quanta(force);
    const FixedForce whole = external.fixed(quanta);
    FixedForce left = whole;
    const auto give = [&](int k, int at, double weight) {
      const FixedForce share = k + 1 < nodes.count ? external.fixed(-weight * quanta) : left;
      for (int c = 0; c < 3; ++c) {
        left.quanta[c] -= share.quanta[c];
        Kokkos::atomic_add(place(at, c), static_cast<std::uint64_t>(-share.quanta[c]));
      }
    };
    for (int c = 0; c < 3; ++c) Kokkos::atomic_add(place(nodes.row[0], c), static_cast<std::uint64_t>(whole.quanta[c]));
    for (int k = 1; k < nodes_of_multiplier; ++k) give(k, nodes.row[k], nodes.weight[k]);
    for (int k = nodes_of_multiplier; k < nodes.count; ++k) give(k, r.row[k], r.weight[k]);
  }

  /// What a sweep makes of a multiplier.
  struct Corrected {
    Vector3 free, force, change;
    double compliance, pressing;
    int slips;
  };

  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Correct& /*phase*/, const int i, int sweep) const {
    MultiplierRow& r = multipliers.rows(i);
    const RowNodes nodes = nodes_of(r);
    if (r.active == 0) return;
    const Vector3 before = r.change;
    const Corrected now = corrected(r, nodes, sweep);
    r.free = now.free;
    r.compliance = now.compliance;
    r.force = now.force;
    r.change = now.change;
    r.pressing = now.pressing;
    scatter(r, nodes, before + now.change, [&](int at, int axis) { return &free_nodes.change(at, sweep & 1, axis); });
  }

  /// A sweep's new force of one multiplier.
  KOKKOS_INLINE_FUNCTION Corrected corrected(const MultiplierRow& r, const RowNodes& nodes, int sweep) const {
    Corrected now;
    Vector3 moves = r.free;
    now.compliance = sweep == 1 ? 0 : r.compliance;
    const auto add = [&](int at, double weight) {
      if (sweep > 1) {
        moves = moves + weight * movement(at, sweep);
        return;
      }
      const FreeNode free = free_nodes.nodes(at);
      moves = moves + weight * free.predicted;
      now.compliance += std::fabs(weight) * free.together;
    };
    for (int k = 0; k < nodes_of_multiplier; ++k) add(nodes.row[k], nodes.weight[k]);
    for (int k = nodes_of_multiplier; k < nodes.count; ++k) add(r.row[k], r.weight[k]);
    now.free = sweep == 1 ? moves : r.free;
    const double opening = dot(moves, r.normal);
    now.pressing = std::fmax(0.0, r.pressing - (r.closing + opening) / now.compliance);
    now.force = now.pressing * r.normal;
    now.slips = 1;
    if constexpr (Friction) {
      Vector3 tangential = r.force - r.pressing * r.normal - (1 / now.compliance) * (moves - opening * r.normal);
      const double bound = r.friction * now.pressing, size = norm(tangential);
      now.slips = size > bound ? 1 : 0;
      if (size > bound) tangential = (bound / size) * tangential;
      now.force = now.force + tangential;
    }
    now.change = now.force - r.force;
    return now;
  }

  /// m, of a node for what multipliers have changed by in this step.
  KOKKOS_INLINE_FUNCTION Vector3 movement(int at, int sweep) const {
    const FreeNode& free = free_nodes.nodes(at);
    Vector3 force;
    for (int c = 0; c < 3; ++c)
      force[c] =
          external.quantum * static_cast<double>(static_cast<long long>(free_nodes.change(at, (sweep - 1) & 1, c)));
    return projected(constraints, free.constraint, free.compliance * force);
  }

  /// The last sweep; leaves forces and status for the next step and for those who read them, and books the work done
  /// since the last.
  KOKKOS_INLINE_FUNCTION void run(const Multiplier::Finish& /*phase*/, const int i, int sweep) const {
    const ContactArrays& contact = search.contact;
    const MultiplierRow& r = multipliers.rows(i);
    const int s = r.slave;
    const RowNodes nodes = nodes_of(r);
    const Vector3 pressed = row(contact.normal_force, s), rubbed = row(contact.tangential_force, s);
    const Vector3 normal = r.normal;
    Vector3 moved = r.moved;
    const double gap = r.gap, gap_before = contact.gap(s);
    Vector3 force = r.force;
    double pressing = r.pressing;
    int slips = r.slips;
    const bool active = r.active != 0;
    if (active) {
      const Vector3 begun = r.begun;
      const Corrected now = corrected(r, nodes, sweep);
      force = now.force;
      pressing = now.pressing;
      slips = now.slips;
      scatter(r, nodes, force - begun, [&](int at, int axis) { return &external.contact(at, axis); });
    }
    if constexpr (Normals::curved) {
      const SegmentPlace place{contact.place(s, 0), contact.place(s, 1)};
      if (active) book_work(s, r.node, contact.tracked(s), place, pressing * normal);
    } else {
      const bool closes = is_distance(gap_before) && is_distance(gap);
      if (closes) multipliers.impact_energy(s) -= 0.5 * (norm(pressed) + pressing) * (gap - gap_before);
    }
    if constexpr (Friction) {
      const Vector3 tangential = force - pressing * normal;
      // A node that begins to touch has come this way along the surface, against half of the force that stops it.
      if (pressing > 0 && contact.status(s) == status_apart)
        moved = first_touch.last.template relative_motion<Normals>(
            search, r.node, contact.tracked(s), SegmentPlace{contact.place(s, 0), contact.place(s, 1)});
      contact.friction_energy(s) -= 0.5 * dot(rubbed + tangential, moved);
      for (int k = 0; k < 3; ++k) contact.tangential_force(s, k) = tangential[k];
    }
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = pressing * normal[k];
    contact.gap(s) = gap;
    contact.status(s) = !(pressing > 0) ? status_apart : slips != 0 ? status_slips : status_sticks;
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
    const NodeArrays& nodes = motion.acceleration.force.nodes;
    const SharedNode shared = free_nodes.shared(at);
    const int n = shared.node & ~special_bit;
    FreeNode free;
    free.constraint = nodes.constraint(n);
    free.compliance = motion.compliance(n);
    free.together = free.compliance * multiplicity_quantum * static_cast<double>(free_nodes.multiplicity(at));
    free.predicted = motion(shared, at);
    free.unused = 0;
    free_nodes.nodes(at) = free;
    free_nodes.multiplicity(at) = 0;
    for (int parity = 0; parity < 2; ++parity)
      for (int axis = 0; axis < 3; ++axis) free_nodes.change(at, parity, axis) = 0;
  }
};

/// A phase of one or two pairs in one launch, over the nodes in their windows.
/// @tparam Pair a ContactMultiplier
template <class Pair, int count>
struct MultiplierPairs {
  Pair pairs[count];
  int sweep;

  /// No loop over the pairs: a GPU's threads would each copy them to memory of their own first, and know no more of a
  /// pointer than that it points somewhere.
  template <class Phase>
  KOKKOS_INLINE_FUNCTION void operator()(const Phase& phase, const int i) const {
    const int of_first = pairs[0].window.launched();
    if (i < of_first)
      pairs[0].item(phase, i, sweep);
    else if constexpr (count == 2)
      pairs[1].item(phase, i - of_first, sweep);
    if constexpr (std::is_same_v<Phase, Multiplier::Finish>)
      if (i == 0) pairs[0].free_nodes.listed_count(0) = 0;
  }
};

}  // namespace railwave
