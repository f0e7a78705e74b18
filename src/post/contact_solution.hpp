#pragma once

#include "post/contact_patch.hpp"

namespace railwave {

/// Contact solution of one pair at one instant.
struct ContactSolution {
  ContactPatch whole;                 ///< of all touching nodes together
  std::vector<ContactPatch> patches;  ///< told apart, small ones too, the one with the largest normal force first
  int stray_nodes = 0;                ///< in small patches beside the others; without others, beside the largest
  double stray_force = 0;             ///< N, sum of their normal forces
};

ContactSolution contact_solution(const ContactState& state, const PatchOptions& options = {});

}  // namespace railwave
