#pragma once

#include <cmath>

namespace railwave {

/// Von Mises' equivalent of a stress xx, yy, zz, xy, yz, zx: sqrt(3/2) times the size of its deviator.
inline double von_mises(const double* s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

}  // namespace railwave
