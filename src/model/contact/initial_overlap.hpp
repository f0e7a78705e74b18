#pragma once

#include <string>
#include <vector>

#include "model/assembled_scene.hpp"
#include "model/contact/contact_pair.hpp"

namespace railwave {

/// A contact whose surfaces cut into each other where the scene is laid out, after close_gap.
struct InitialOverlap {
  const scene::Contact* contact = nullptr;
  int nodes = 0;           ///< of the slave inside the master's body
  double depth = 0;        ///< m, the largest distance of such a node to the master's surface
  double share = 0;        ///< of the size of the master's face there, the root of its area
  Vec3 place{0, 0, 0};     ///< m, of the deepest node
  Vec3 outwards{0, 0, 0};  ///< from it to the surface, of length 1: that way by `depth` the slave's part has to go
  bool deep = false;       ///< more than its springs, or settling, take up without a blow
};

/// Overlaps beyond rounding (a hundred-thousandth of a face's size), the scene's contacts in order.
/// @param step_size s, of the run: within a step multipliers close a gap
std::vector<InitialOverlap> initial_overlaps(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                                             double step_size);

/// A sentence: the contact's entry and line, depth, place, and how to mend it.
std::string describe(const scene::Scene& scene, const InitialOverlap& overlap);

/// How to mend it: where the slave's part should go, or how the gap is closed.
std::string mend_of(const InitialOverlap& overlap);

}  // namespace railwave
