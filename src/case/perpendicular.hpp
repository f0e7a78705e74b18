#pragma once

#include <cmath>

#include "case/scene.hpp"

namespace railwave {

/// Whether each direction that the one motion prescribes is perpendicular to each of the other's: with P the sum of
/// d d^T over the directions of a motion, P_1 P_2 = 0. Then both may move the same nodes, and neither changes what the
/// other one does there; of oblique motions each would change what the other prescribes.
/// @return also true where one of them prescribes nothing
inline bool perpendicular(const scene::PrescribedMotion& one, const scene::PrescribedMotion& other) {
  constexpr double rounding = 1e-6;  // of axes that a case file gives in decimals
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      if (!one.directions[a] || !other.directions[b]) continue;
      double cosine = 0;
      for (int i = 0; i < 3; ++i) cosine += one.axes[a][i] * other.axes[b][i];
      if (std::fabs(cosine) > rounding) return false;
    }
  return true;
}

/// How two that are not can be mended.
inline constexpr const char* perpendicular_advice =
    "motions of common nodes must have perpendicular `directions`, such as directions = [\"x\"] of the one and "
    "directions = [\"z\"] of the other; one motion may have velocity, rotation and displacement together";

}  // namespace railwave
