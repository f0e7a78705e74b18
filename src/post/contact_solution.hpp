#pragma once

#include "post/contact_patch.hpp"

namespace railwave {

/// Contact solution of one pair at one instant.
struct ContactSolution {
  ContactPatch whole;                 ///< of all touching nodes together
  std::vector<ContactPatch> patches;  ///< told apart, the one with the largest normal force first
  int stray_nodes = 0;                ///< touch, but lie apart from every patch, fewer than `smallest_patch` together
  double stray_force = 0;             ///< N, sum of their normal forces
};

/// Touching nodes that hang together count as a patch from this number on: a facet's corners. Fewer, as chatter leaves them
/// at the edges, are strays; where there are no others, those with the largest force are the patch.
inline constexpr int smallest_patch = 4;

ContactSolution contact_solution(const ContactState& state, const PatchOptions& options = {});

}  // namespace railwave
