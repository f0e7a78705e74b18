#pragma once

#include "kernels/support/spaces.hpp"

namespace railwave {

/// Damping of one part's elements.
struct DampingConstants {
  double lambda, mu;  ///< Pa s: stiffness_damping times Lame's constants
  double linear;      ///< Pa s/m: Q2 rho c, of bulk viscosity
  double quadratic;   ///< kg/m3: Q1 rho
};

/// What groups of damped elements have besides; empty for others.
struct DampingArrays {
  Array<DampingConstants*> constants;  ///< by the blocks' material row
  Array<double*> node_drag;  ///< kg/s, by place in the blocks' lists: mass damping and absorbing layers there, times
                             ///< the mass that the block's elements give the node
  Array<double*> energy;     ///< J dissipated so far, by block
  int first_partial = 0;     ///< row of the damping forces on the first block's first node in the partial forces
  bool active() const { return energy.extent(0) > 0; }
};

}  // namespace railwave
