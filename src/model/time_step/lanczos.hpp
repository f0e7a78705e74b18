#pragma once

#include <vector>

namespace railwave {

/// The largest eigenvalue of the tridiagonal matrix that Lanczos' recurrence has made of a symmetric operator so far.
struct RitzValue {
  double value = 0;     ///< at most the operator's largest eigenvalue
  double residual = 0;  ///< an eigenvalue of the operator lies within this of `value`
};

/// @param diagonal alpha_1 ... alpha_m
/// @param beside beta_1 ... beta_m; the last one leads to the vector not yet used
RitzValue largest_ritz_value(const std::vector<double>& diagonal, const std::vector<double>& beside);

}  // namespace railwave
