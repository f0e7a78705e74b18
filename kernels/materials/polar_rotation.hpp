#pragma once

#include "kernels/materials/plastic_flow.hpp"
#include "kernels/support/lane_choice.hpp"

namespace railwave {

/// The rotation Q of the polar decomposition A = Q P of a matrix of positive determinant, by Newton's iteration
/// Q <- (Q + Q^-T)/2 (Higham 1986): a stretch 1 + d becomes 1 + d^2/2, so that four iterations bring 5 % to rounding
/// and seven a stretch of 4. Ends when the next iteration could change nothing, lane by lane alike wherever it is
/// computed.
template <class S, class T>
KOKKOS_FORCEINLINE_FUNCTION void polar_rotation(const T (&A)[3][3], T (&Q)[3][3]) {
  constexpr int most_iterations = 20;
  constexpr double close_enough =
      sizeof(S) < sizeof(double) ? 1e-8 : 1e-16;  // the square of what leaves half its square
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Q[i][j] = A[i][j];
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    T inverted[3][3];
    inverse<S>(Q, inverted);
    T change = S(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const T half = S(0.5) * (inverted[j][i] - Q[i][j]);
        Q[i][j] += half;
        change += half * half;
      }
    if (!any_lane(change > T(S(close_enough)))) return;
  }
}

}  // namespace railwave
