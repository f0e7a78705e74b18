#pragma once

#include "kernels/nodes/external_force_sum.hpp"
#include "kernels/support/lanes.hpp"
#include "kernels/support/team.hpp"

namespace railwave {

/// State and constant data of all nodes. Forces at an instant t_n, velocities half a step before it.
struct NodeArrays {
  int count = 0;
  Array<double* [3]> reference;  ///< m, undeformed
  Array<double* [3]> position;   ///< m, at t_n
  Array<double* [3]> velocity;   ///< m/s, at t_n - step/2
  Array<double*> mass;           ///< kg, lumped
  Array<int*>
      first_partial;  ///< count + 1; a node's partial forces are partial_place[first_partial(n)] ... in fixed order
  Array<int*> partial_place;  ///< rows of the partial forces: one for each block that the node belongs to
  Array<int*> external_row;   ///< row in ExternalForces (loads, connectors, contact), -1: none
  Array<int*> constraint;     ///< row in the constraint table, -1: free
};

/// A force in a row of its own, read and written at once.
template <class S>
struct alignas(4 * sizeof(S)) PartialForce {
  S x[4];
};

/// A node of several blocks, or of one that does not advance it by itself: where its partial forces lie, with what is
/// asked of memory at once. Most belong to two blocks.
struct alignas(16) SharedNode {
  int node;      ///< with `special_bit` where external forces or a constraint concern it
  int place[2];  ///< its first partial forces, -1: none
  int more;      ///< 0: there are no others; else one more than where MorePlaces has them
};
inline constexpr int special_bit = static_cast<int>(0x80000000u);

/// A shared node's further partial forces.
struct alignas(16) MorePlaces {
  static constexpr int count = 6;
  int place[count];  ///< -1: none
  int first, last;   ///< in NodeArrays::partial_place: those for which there is no room here
};

/// What external forces and constraints ask of a shared node.
struct alignas(16) SpecialNode {
  int row = -1;                     ///< in ExternalForces, -1: none
  int first_share = 0, shares = 0;  ///< its contributions there
  int constraint = -1;              ///< row in the constraint table, -1: free
};

/// What the blocks' elements do to their nodes, N: one row for each node of each block, in the precision of the
/// elements.
struct PartialForces {
  Array<PartialForce<double>*> in_double;
  Array<PartialForce<float>*> in_single;
  Array<MorePlaces*> more;
  bool single_precision = false;

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION const PartialForce<S>* in() const {
    if constexpr (sizeof(S) == sizeof(float))
      return in_single.data();
    else
      return in_double.data();
  }

  KOKKOS_INLINE_FUNCTION Vector3 operator()(int place) const {
    if (single_precision) {
      const PartialForce<float> f = in_single(place);
      return {{f.x[0], f.x[1], f.x[2]}};
    }
    const PartialForce<double> f = in_double(place);
    return {{f.x[0], f.x[1], f.x[2]}};
  }

  /// Some rows, of which memory is asked at once: on a GPU a node's thread does little but wait.
  template <int count>
  struct Rows {
    Vector3 force[count];
    bool there[count];

    KOKKOS_INLINE_FUNCTION Vector3 added_to(Vector3 sum) const {
      for (int k = 0; k < count; ++k)
        if (there[k]) sum = sum + force[k];
      return sum;
    }
  };

  /// @param place -1: none
  /// @param any a row that there is
  template <int count>
  KOKKOS_INLINE_FUNCTION Rows<count> rows(const int (&place)[count], int any) const {
    Rows<count> rows;
    for (int k = 0; k < count; ++k) rows.there[k] = place[k] >= 0;
    for (int k = 0; k < count; ++k)
      if (on_device || rows.there[k]) rows.force[k] = (*this)(rows.there[k] ? place[k] : any);
    return rows;
  }
};

/// Sum of the element forces on a node and of its external forces, in fixed order, N.
struct NodalForce {
  NodeArrays nodes;
  PartialForces partial;
  ExternalForceSum external;

  /// The same for a kernel that is compiled for one number type of the partial forces: it does not ask at each.
  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION NodalForce with_partials_in() const {
    NodalForce known = *this;
    known.partial.single_precision = sizeof(S) == sizeof(float);
    return known;
  }

  KOKKOS_INLINE_FUNCTION Vector3 external_force(int n) const {
    const int r = nodes.external_row(n);
    return r >= 0 ? external.force(r) : Vector3{{0, 0, 0}};
  }

  KOKKOS_INLINE_FUNCTION Vector3 operator()(int n) const {
    return with_partials(external_force(n), nodes.first_partial(n), nodes.first_partial(n + 1));
  }

  /// Adds partial forces.
  /// @param first, last in NodeArrays::partial_place
  KOKKOS_INLINE_FUNCTION Vector3 with_partials(Vector3 force, int first, int last) const {
    constexpr int batch = on_device ? 4 : 1;
    for (int c = first; c < last; c += batch) {
      int place[batch];
      for (int k = 0; k < batch; ++k) place[k] = c + k < last ? nodes.partial_place(c + k) : -1;
      force = partial.rows(place, place[0]).added_to(force);
    }
    return force;
  }

#ifdef RAILWAVE_SIMD_LANES
  /// Asks for what moving the node will read. Three components may lie in two lines of the cache.
  KOKKOS_FORCEINLINE_FUNCTION void prefetch_shared(const SharedNode& node) const {
    const int n = node.node & ~special_bit;
    prefetch(&nodes.position(n, 0));
    prefetch(&nodes.position(n, 2));
    prefetch(&nodes.velocity(n, 0));
    prefetch(&nodes.velocity(n, 2));
    prefetch(&nodes.mass(n));
    prefetch_partials(node);
  }

  /// Asks for a shared node's partial forces, but for those for which MorePlaces has no room.
  KOKKOS_FORCEINLINE_FUNCTION void prefetch_partials(const SharedNode& node) const {
    if (partial.single_precision)
      prefetch_rows(node, partial.in_single.data());
    else
      prefetch_rows(node, partial.in_double.data());
  }

  template <class Row>
  KOKKOS_FORCEINLINE_FUNCTION void prefetch_rows(const SharedNode& node, const Row* rows) const {
    for (int place : node.place)
      if (place >= 0) prefetch(rows + place);
    if (node.more == 0) return;
    for (int place : partial.more(node.more - 1).place)
      if (place >= 0) prefetch(rows + place);
  }

  /// Asks for a node's partial forces.
  KOKKOS_FORCEINLINE_FUNCTION void prefetch_partials(int n) const {
    if (partial.single_precision) return;
    for (int c = nodes.first_partial(n); c < nodes.first_partial(n + 1); ++c)
      prefetch(&partial.in_double(nodes.partial_place(c)));
  }
#endif

  /// Calls act(place) for each of a shared node's partial forces, in their order, until it returns false.
  template <class Act>
  KOKKOS_FORCEINLINE_FUNCTION void each_place(const SharedNode& shared, const Act& act) const {
    for (int place : shared.place)
      if (place < 0 || !act(place)) return;
    if (shared.more == 0) return;
    const MorePlaces& more = partial.more(shared.more - 1);
    for (int place : more.place)
      if (place < 0 || !act(place)) return;
    for (int c = more.first; c < more.last; ++c)
      if (!act(nodes.partial_place(c))) return;
  }

#ifdef RAILWAVE_SIMD_LANES
  /// Adds a shared node's partial forces, N, to a sum of whose four numbers the last has no meaning: a host adds all at
  /// once.
  /// @tparam S their number type
  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION PartialForce<double> with_all_partials(const SharedNode& shared,
                                                                     PartialForce<double> sum = {}) const {
    const PartialForce<S>* const rows = partial.in<S>();
    each_place(shared, [&](int place) {
      for (int k = 0; k < 4; ++k) sum.x[k] += static_cast<double>(rows[place].x[k]);
      return true;
    });
    return sum;
  }
#endif

  /// The first partial forces of a shared node, on a device: a host asks for them when it adds them.
  KOKKOS_INLINE_FUNCTION PartialForces::Rows<2> first_rows(const SharedNode& shared) const {
    if (!on_device || shared.place[0] < 0) return {{}, {false, false}};
    return partial.rows(shared.place, shared.place[0]);
  }

  /// Sum of a shared node's partial forces and others, N.
  /// @param first of first_rows(); a host does without
  KOKKOS_INLINE_FUNCTION Vector3 with_rows(Vector3 force, const SharedNode& shared,
                                           [[maybe_unused]] const PartialForces::Rows<2>& first) const {
#ifdef RAILWAVE_SIMD_LANES
    const PartialForce<double> begin{{force[0], force[1], force[2], 0}};
    const PartialForce<double> sum =
        partial.single_precision ? with_all_partials<float>(shared, begin) : with_all_partials<double>(shared, begin);
    return {{sum.x[0], sum.x[1], sum.x[2]}};
#else
    if (shared.more == 0) return first.added_to(force);
    const MorePlaces more = partial.more(shared.more - 1);
    const PartialForces::Rows<MorePlaces::count> others = partial.rows(more.place, shared.place[0]);
    return with_partials(others.added_to(first.added_to(force)), more.first, more.last);
#endif
  }
};

/// m/s2
KOKKOS_INLINE_FUNCTION Vector3 acceleration_under(const Vector3& force, double inverse_mass, const Vector3& gravity) {
  Vector3 a;
  for (int i = 0; i < 3; ++i) a[i] = multiply_add(inverse_mass, force[i], gravity[i]);
  return a;
}

/// Central difference of the thesis's table 2.1, (i) and (j), eqs. 2.11 and 2.12, for a node whose acceleration is
/// known.
struct NodeAdvance {
  NodeArrays nodes;
  Vector3 gravity;       ///< m/s2
  double velocity_step;  ///< s: half a step at the first one, which starts from velocities at t = 0
  double step;           ///< s

  KOKKOS_INLINE_FUNCTION Vector3 acceleration(double inverse_mass, const Vector3& force) const {
    return acceleration_under(force, inverse_mass, gravity);
  }

  KOKKOS_INLINE_FUNCTION void move(int n, const Vector3& a) const {
    move(n, a, row(nodes.position, n), row(nodes.velocity, n));
  }

  /// @param x, v the node's present position and velocity, where they are at hand
  /// @param steps so many at once
  KOKKOS_INLINE_FUNCTION void move(int n, const Vector3& a, const Vector3& x, const Vector3& v, int steps = 1) const {
    for (int i = 0; i < 3; ++i) {
      const double next = multiply_add(steps * velocity_step, a[i], v[i]);
      nodes.velocity(n, i) = next;
      nodes.position(n, i) = multiply_add(steps * step, next, x[i]);
    }
  }

#ifdef RAILWAVE_SIMD_LANES
  /// The same for a node of a host under a force, N, that is all that acts on it beside gravity.
  /// @param x its present position's first two components, `x_last` the third
  /// @param v its present velocity
  void move_under(int n, double inverse_mass, const double* force, const double* x, double x_last,
                  const double* v) const {
#if defined(__FMA__)
    // Two components at once.
    double *x_next = &nodes.position(n, 0), *v_next = &nodes.velocity(n, 0);
    const __m128d a = _mm_fmadd_pd(_mm_set1_pd(inverse_mass), _mm_loadu_pd(force), _mm_loadu_pd(gravity.x));
    const __m128d next = _mm_fmadd_pd(_mm_set1_pd(velocity_step), a, _mm_loadu_pd(v));
    const double a_last = multiply_add(inverse_mass, force[2], gravity[2]);
    const double next_last = multiply_add(velocity_step, a_last, v[2]);
    _mm_storeu_pd(v_next, next);
    v_next[2] = next_last;
    _mm_storeu_pd(x_next, _mm_fmadd_pd(_mm_set1_pd(step), next, _mm_loadu_pd(x)));
    x_next[2] = multiply_add(step, next_last, x_last);
#else
    const Vector3 a = acceleration(inverse_mass, {{force[0], force[1], force[2]}});
    move(n, a, {{x[0], x[1], x_last}}, {{v[0], v[1], v[2]}});
#endif
  }

  void move_under(int n, double inverse_mass, const double* force) const {
    const double* const x = &nodes.position(n, 0);
    move_under(n, inverse_mass, force, x, x[2], &nodes.velocity(n, 0));
  }
#endif
};

/// A vector without its components along held directions. Each row of the table is I - sum d d^T over directions d.
/// @param c row; -1: nothing is held
template <class Table>
KOKKOS_FORCEINLINE_FUNCTION Vector3 projected(const Table& table, int c, const Vector3& a) {
  if (c < 0) return a;
  Vector3 free;
  for (int i = 0; i < 3; ++i) free[i] = table(c, i, 0) * a[0] + table(c, i, 1) * a[1] + table(c, i, 2) * a[2];
  return free;
}

/// Acceleration with displacement constraints: components along constrained directions are zero (thesis 2.7,
/// eqs. 2.31). A constrained direction keeps the velocity it began with.
struct NodalAcceleration {
  NodalForce force;
  Vector3 gravity;                          ///< m/s2
  Array<const double* [3][3]> constraints;  ///< projections

  KOKKOS_INLINE_FUNCTION Vector3 constrain(int n, const Vector3& a) const {
    return projected(constraints, force.nodes.constraint(n), a);
  }

  KOKKOS_INLINE_FUNCTION Vector3 operator()(int n) const {
    return constrain(n, acceleration_under(force(n), 1.0 / force.nodes.mass(n), gravity));
  }
};

/// Step 3 of the thesis's table 2.1, (f) to (j): forces, acceleration, constraints, central difference. Contact
/// forces, once used, are cleared for the next instant.
struct NodeUpdate {
  NodalAcceleration acceleration;
  NodeAdvance advance;
  Array<const int*> listed = {};  ///< nodes to move; empty: all

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int n = listed.extent(0) > 0 ? listed(i) : i;
    advance.move(n, acceleration(n));
    if (advance.nodes.external_row(n) >= 0) acceleration.force.external.clear_contact(advance.nodes.external_row(n));
  }
};

}  // namespace railwave
