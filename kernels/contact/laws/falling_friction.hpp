#pragma once

#include <cmath>

#include "kernels/support/vector3.hpp"

namespace railwave {

/// How a node has slid over the master.
struct Sliding {
  Vector3 moved;   ///< m, since the instant before; what a spring between took up is no sliding
  double elapsed;  ///< s since then; 0: there is none
};

/// Friction that falls with the speed of sliding: at_speed + (at_rest - at_speed) exp(-decay |w|), thesis eq. 2.29. w
/// is the velocity of sliding as the contact remembers it: its mean over the past, weighted by exp(-t / memory). Where
/// friction answers at once, a node slides faster because it slides: every disturbance grows, the shorter the faster,
/// and the nodes of a mesh stick and slip in turn. docs/contact.md says how much memory a contact needs.
struct FallingFriction {
  static constexpr int state_values = 4;
  static constexpr int now = 0;         ///< of the state: the coefficient that acts
  static constexpr int remembered = 1;  ///< and two more: w, m/s

  double at_rest, at_speed;
  double decay;   ///< s/m
  double memory;  ///< s; 0: none

  KOKKOS_INLINE_FUNCTION double coefficient(const Sliding& sliding, double* state) const {
    double square = 0;
    const double kept = !(sliding.elapsed > 0) ? 1.0 : memory > 0 ? std::exp(-sliding.elapsed / memory) : 0.0;
    for (int k = 0; k < 3; ++k) {
      double& w = state[remembered + k];
      if (kept < 1) w = kept * w + (1 - kept) * sliding.moved[k] / sliding.elapsed;
      square += w * w;
    }
    state[now] = at_speed + (at_rest - at_speed) * std::exp(-decay * std::sqrt(square));
    return state[now];
  }

  /// The node has come off.
  KOKKOS_INLINE_FUNCTION void forget(double* state) const {
    state[now] = at_rest;
    for (int k = 0; k < 3; ++k) state[remembered + k] = 0;
  }
};

}  // namespace railwave
