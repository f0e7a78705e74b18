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

  KOKKOS_INLINE_FUNCTION Vector3 operator()(int n) const {
    if (levels.level.extent(0) == 0) return plain(n);
    const NodeArrays& nodes = plain.force.nodes;
    Vector3 force = plain.force.external_force(n);
    int level = levels.level(n);
    double steps = 1;
    for (int c = nodes.first_partial(n); c < nodes.first_partial(n + 1); ++c) {
      const int place = nodes.partial_place(c);
      while (place >= levels.row_end[level]) {
        ++level;
        steps *= 2;
      }
      if (level > phase) break;
      force = force + steps * plain.force.partial(place);
    }
    return plain.constrain(n, NodeAdvance{nodes, plain.gravity, 0, 0}.acceleration(1.0 / nodes.mass(n), force));
  }
};

/// NodeUpdate for the nodes whose own step begins at this instant.
struct SubcycledNodeUpdate {
  SubcycledAcceleration acceleration;
  NodeAdvance advance;              ///< of the finest nodes
  Array<const SharedNode*> shared;  ///< the nodes concerned; empty: all

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int n = shared.extent(0) == 0 ? i : shared(i).node & ~special_bit;
    if (acceleration.levels.level(n) > acceleration.phase) return;
    const int steps = acceleration.levels.steps(n);
    const NodeAdvance own{advance.nodes, advance.gravity, steps * advance.velocity_step, steps * advance.step};
    own.move(n, acceleration(n));
    if (advance.nodes.external_row(n) >= 0)
      acceleration.plain.force.external.clear_contact(advance.nodes.external_row(n));
  }
};

}  // namespace railwave
