#pragma once

#include "kernels/loads/set_loads.hpp"

namespace railwave {

/// The nodes that no block advances by itself.
struct SharedNodes {
  Array<SharedNode*> nodes;
  Array<SpecialNode*> special;  ///< of those from `first_special` on
  int first_special = 0;        ///< external forces and constraints concern none before it

  KOKKOS_INLINE_FUNCTION SpecialNode special_of(int i) const {
    return i < first_special ? SpecialNode{} : special(i - first_special);
  }
};

/// Step 3 of the thesis's table 2.1 for shared nodes. Where the laws of torques and connectors have been evaluated but
/// not yet shared out, a node works out its own loads here, beside the many that have none.
struct SharedForces {
  static constexpr int shares_at_once = on_device ? 2 : 1;  ///< few: more take registers

  NodalAcceleration acceleration;
  SharedNodes shared;
  RowLoads rows;
  bool rows_here;

  /// N, but for gravity.
  KOKKOS_INLINE_FUNCTION Vector3 operator()(const SharedNode& node, const SpecialNode& special) const {
    const NodalForce& force = acceleration.force;
    const auto first = force.first_rows(node);
    Vector3 external{{0, 0, 0}};
    if (special.row >= 0) {
      const Vector3 contact = force.external.contact_force(special.row);
      const LoadedRow loaded{special.row, node.node & ~special_bit, special.first_share,
                             special.first_share + special.shares};
      if (rows_here && special.shares > 0)
        external = rows.gather<shares_at_once>(loaded) + contact;
      else
        external = row(force.external.load, special.row) + contact;
    }
    return force.with_rows(external, node, first);
  }

  /// Contact forces, once used, are cleared for the next instant.
  KOKKOS_INLINE_FUNCTION void clear_contact(const SpecialNode& special) const {
    if (special.row >= 0) acceleration.force.external.clear_contact(special.row);
  }
};

struct SharedNodeUpdate {
  SharedForces forces;
  NodeAdvance advance;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
#ifdef RAILWAVE_SIMD_LANES
    if (i + prefetch_ahead < static_cast<int>(forces.shared.nodes.extent(0)))
      forces.acceleration.force.prefetch_shared(forces.shared.nodes(i + prefetch_ahead));
#endif
    const SharedNode node = forces.shared.nodes(i);
    const SpecialNode special = forces.shared.special_of(i);
    const int n = node.node & ~special_bit;
    const double inverse_mass = 1.0 / advance.nodes.mass(n);
#ifdef RAILWAVE_SIMD_LANES
    if (special.constraint < 0) {
      advance.move_under(n, inverse_mass, forces(node, special).x);
      return forces.clear_contact(special);
    }
#endif
    const Vector3 x = row(advance.nodes.position, n), v = row(advance.nodes.velocity, n);
    const Vector3 a = advance.acceleration(inverse_mass, forces(node, special));
    advance.move(n, projected(forces.acceleration.constraints, special.constraint, a), x, v);
    forces.clear_contact(special);
  }
};

/// The same for nodes that nothing but elements and gravity concerns: nearly all are such. A thread of a GPU needs half
/// the registers without what is asked for special ones, so that twice as many wait for memory at a time; a host has a
/// short loop, and its threads as many of these as of those.
/// @tparam S number type of the partial forces
template <class S>
struct PlainNodeUpdate {
  NodalForce force;
  Array<const SharedNode*> shared;
  NodeAdvance advance;

#ifdef RAILWAVE_SIMD_LANES
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const int i) const {
    if (i + prefetch_ahead < static_cast<int>(shared.extent(0))) force.prefetch_shared(shared(i + prefetch_ahead));
    const SharedNode& node = shared(i);
    const PartialForce<double> sum = force.with_all_partials<S>(node);
    advance.move_under(node.node, 1.0 / advance.nodes.mass(node.node), sum.x);
  }
#else
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const NodalForce sum = force.with_partials_in<S>();
    const SharedNode node = shared(i);
    const double inverse_mass = 1.0 / advance.nodes.mass(node.node);
    const Vector3 x = row(advance.nodes.position, node.node), v = row(advance.nodes.velocity, node.node);
    const Vector3 f = sum.with_rows({{0, 0, 0}}, node, sum.first_rows(node));
    advance.move(node.node, advance.acceleration(inverse_mass, f), x, v);
  }
#endif
};

}  // namespace railwave
