#pragma once

#include <vector>

#include "model/model.hpp"
#include "solve/monitor/fault.hpp"
#include "solve/monitor/watch_measures.hpp"

namespace railwave {

/// What is known when something is found: the first look, the last with finite values, and what was seen between.
struct WatchEvidence {
  WatchMeasures first, last;
  Extreme worst_shape;          ///< smallest Jacobian at a corner over the mean of its element, undeformed
  std::vector<double> deepest;  ///< by contact pair: largest penetration so far, over the face's size
  std::vector<int> touching;    ///< by contact of the scene: nodes in contact now
  double kinetic_share = 0;     ///< kinetic energy over the work of loads, where these work
};

/// What may have brought a fault about, the likeliest first: from the step against what elements, contact springs,
/// connectors and beams allow, from what the case asks for (loads, speeds, materials, hourglass control, curves) and
/// from what the first look saw (penetration, shape).
std::vector<Cause> likely_causes(const Model& model, const Fault& fault, const WatchEvidence& evidence);

}  // namespace railwave
