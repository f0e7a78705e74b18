#pragma once

#include <Kokkos_Core.hpp>

/// A contact law says with what a node presses on the other body and what friction can hold, from numbers alone: it
/// knows no arrays, no search and no motion. kernels/contact/law_at_nodes.hpp brings it to the nodes. It is a struct
/// with its parameters and these members, in a file of its own here, listed in src/model/contact/contact_law.hpp:
///
/// | member | what |
/// |---|---|
/// | `state_values` | doubles that each slave node keeps from step to step, zero at the start; 0: none |
/// | `asks_approach()` | whether it wants `approach`, `inverse_mass` and `elapsed`; only a law with a state gets them |
/// | `spring(k)` | N/m, of the springs of a segment whose penalty has k |
/// | `touches(point, state)` | whether there is contact |
/// | `pressing(point, state)` | N, the normal force, never a pull unless the law is one of adhesion |
/// | `friction_before(state)` | the coefficient of the instant before |
/// | `friction(sliding, state)` | coefficient that bounds the tangential force, see laws/falling_friction.hpp |
/// | `part(point, state)` | the node has come off |
/// | `stored(point, normal_square, tangential_square)` | J in the springs, from the forces' squares, N2 |
/// | `dissipated(state)` | J that the law has taken out so far, beside friction |
namespace railwave {

/// The place where a node nears or presses on the other body, in numbers.
struct ContactPoint {
  double gap;               ///< m; negative: penetration
  double stiffness;         ///< N/m, of the springs there
  double approach = 0;      ///< m/s, positive: they near each other
  double inverse_mass = 0;  ///< 1/kg, of the contact as one mass that meets a wall
  double elapsed = 0;       ///< s since the instant before; 0: there is none, or time has no meaning
};

}  // namespace railwave
