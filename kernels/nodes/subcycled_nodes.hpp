#pragma once

#include "kernels/nodes/nodes.hpp"

/// Subcycling: elements of level l are evaluated every 2^l steps, and each evaluation gives the element's nodes the
/// impulse of 2^l steps at once; a node moves with constant velocity from one impulse to the next (asynchronous
/// variational integration: Lew, Marsden, Ortiz and West 2003). All nodes of an element feel the same evaluation, so
/// linear and angular momentum are kept to rounding, and the scheme is symplectic, so that energy does not drift.
namespace railwave {

inline constexpr int most_levels = 6;

/// The level of each node: that of the finest element or external force that concerns it.
struct SubcycleLevels {
  Array<const std::uint8_t*> level;  ///< by node; empty: all nodes take every step
  int row_end[most_levels] = {};     ///< partial forces of rows below row_end[l] come from elements of levels 0 ... l

  /// Steps from one impulse to the next.
  KOKKOS_INLINE_FUNCTION int steps(int n) const { return level.extent(0) == 0 ? 1 : 1 << level(n); }
};

/// The acceleration that, acting for a node's own step, is the impulse of an instant, m/s2.
struct SubcycledAcceleration {
  NodalAcceleration plain;
  SubcycleLevels levels;
  int phase = most_levels - 1;  ///< elements of levels 0 ... phase are evaluated at this instant

  /// Partial forces, the finer levels' first, over the node's own step, N.
  struct Sum {
    Vector3 force;
    int level;         ///< of the last one
    double steps = 1;  ///< of that level over the node's own
  };

  /// @return false: this one and those that follow it are not due
  KOKKOS_FORCEINLINE_FUNCTION bool add(int place, Sum& sum) const {
    while (place >= levels.row_end[sum.level]) {
      ++sum.level;
      sum.steps *= 2;
    }
    if (sum.level > phase) return false;
    sum.force = sum.force + sum.steps * plain.force.partial(place);
    return true;
  }

  KOKKOS_INLINE_FUNCTION Vector3 operator()(int n) const {
    if (levels.level.extent(0) == 0) return plain(n);
    const NodeArrays& nodes = plain.force.nodes;
    Sum sum{plain.force.external_force(n), levels.level(n)};
    for (int c = nodes.first_partial(n); c < nodes.first_partial(n + 1); ++c)
      if (!add(nodes.partial_place(c), sum)) break;
    return plain.constrain(n, acceleration_under(sum.force, 1.0 / nodes.mass(n), plain.gravity));
  }

  /// The same of a shared node that nothing but elements concerns, with the places of its forces at hand.
  KOKKOS_FORCEINLINE_FUNCTION Vector3 of_elements(const SharedNode& node) const {
    Sum sum{{{0, 0, 0}}, levels.level(node.node)};
    plain.force.each_place(node, [&](int place) { return add(place, sum); });
    return acceleration_under(sum.force, 1.0 / plain.force.nodes.mass(node.node), plain.gravity);
  }
};

/// NodeUpdate for the nodes whose own step begins at this instant.
struct SubcycledNodeUpdate {
  SubcycledAcceleration acceleration;
  NodeAdvance advance;              ///< of the finest nodes
  Array<const SharedNode*> shared;  ///< the nodes concerned; empty: all

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    if (shared.extent(0) == 0) return move(i, SharedNode{i | special_bit, {-1, -1}, 0});
#ifdef RAILWAVE_SIMD_LANES
    if (i + prefetch_ahead < static_cast<int>(shared.extent(0)))
      acceleration.plain.force.prefetch_shared(shared(i + prefetch_ahead));
#endif
    const SharedNode node = shared(i);
    move(node.node & ~special_bit, node);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void move(int n, const SharedNode& node) const {
    if (acceleration.levels.level(n) > acceleration.phase) return;
    const Vector3 a = node.node >= 0 ? acceleration.of_elements(node) : acceleration(n);
    advance.move(n, a, row(advance.nodes.position, n), row(advance.nodes.velocity, n), acceleration.levels.steps(n));
    if (node.node < 0 && advance.nodes.external_row(n) >= 0)
      acceleration.plain.force.external.clear_contact(advance.nodes.external_row(n));
  }
};

}  // namespace railwave
