#pragma once

#include "kernels/contact/laws/growing_penalty.hpp"
#include "kernels/spaces.hpp"

namespace railwave {

/// What a pair keeps for its law.
struct ContactLawArrays {
  int number = 0;                       ///< of the law among `ContactLaws`, see src/model/contact_law.hpp
  double damping = 0;                   ///< share of critical damping
  Array<PenaltyGrowth::Point*> growth;  ///< empty without
  Array<double*> state;                 ///< the law's state, value by value, each by slave node
};

}  // namespace railwave
