#pragma once

#include "kernels/loads/set_loads.hpp"

namespace railwave {

/// Step 3 of the thesis's table 2.1 for the nodes that the blocks have left. Where the laws of torques and connectors
/// have been evaluated but not yet shared out, a node works out its own loads here, beside the many that have none.
struct SharedNodeUpdate {
  NodalAcceleration acceleration;
  NodeAdvance advance;
  Array<const SharedNode*> shared;
  RowLoads rows;
  bool rows_here;

#ifdef RAILWAVE_SIMD_LANES
  /// So many nodes later what is asked of memory now has come; 12 and 24 are as good.
  static constexpr int ahead = 12;

  KOKKOS_FORCEINLINE_FUNCTION void prefetch_node(const SharedNode& node) const {
    const int n = node.node & ~special_bit;
    prefetch(&advance.nodes.position(n, 0));
    prefetch(&advance.nodes.velocity(n, 0));
    const PartialForces& partial = acceleration.force.partial;
    if (partial.single_precision) return;
    for (int place : node.place)
      if (place >= 0) prefetch(&partial.in_double(place));
  }
#endif

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
#ifdef RAILWAVE_SIMD_LANES
    if (i + ahead < static_cast<int>(shared.extent(0))) prefetch_node(shared(i + ahead));
#endif
    const SharedNode node = shared(i);
    const int n = node.node & ~special_bit;
    const double inverse_mass = 1.0 / advance.nodes.mass(n);
    const Vector3 x = row(advance.nodes.position, n), v = row(advance.nodes.velocity, n);
    const int r = node.node < 0 ? advance.nodes.external_row(n) : -1;
    if (rows_here && r >= 0 && rows.external.loaded_of_row(r) >= 0) rows.gather<1>(rows.external.loaded_of_row(r));
    Vector3 a = advance.acceleration(inverse_mass, acceleration.force(node));
    if (node.node < 0) a = acceleration.constrain(n, a);
    advance.move(n, a, x, v);
    if (r >= 0) acceleration.force.external.clear_contact(r);
  }
};

}  // namespace railwave
