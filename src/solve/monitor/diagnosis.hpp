#pragma once

#include <vector>

#include "model/assembled_scene.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/loads/load_model.hpp"
#include "model/time_step/step_sizes.hpp"
#include "solve/monitor/fault.hpp"
#include "solve/monitor/monitor_measures.hpp"

namespace railwave {

/// What is known when something is found: the first check, the last with finite values, and what was seen between.
struct MonitorEvidence {
  MonitorMeasures first, last;
  Extreme worst_shape;          ///< smallest Jacobian at a corner over the mean of its element, undeformed
  std::vector<double> deepest;  ///< by contact pair: largest penetration so far, over the face's size
  std::vector<int> touching;    ///< by contact of the scene: nodes in contact now
  double kinetic_share = 0;     ///< kinetic energy over the work of loads, where these work
};

/// What may have brought a fault about, the likeliest first: from the step against what elements, contact springs,
/// connectors and beams allow, from what the case asks for (loads, speeds, materials, hourglass control, curves) and
/// from what the first check saw (penetration, shape).
std::vector<Cause> likely_causes(const AssembledScene& assembled, const StepSizes& sizes, const LoadModel& loads,
                                 const std::vector<ContactPair>& contacts, const Fault& fault,
                                 const MonitorEvidence& evidence);

/// The name of a cause that may be one only where a body is one element thick.
inline constexpr const char* possible_step_cause = "step beyond elements alone";

/// For each of elements, hourglass control, contact springs, connectors and beams that the run's step is too long for:
/// by how much, who it is, and the mend. The one that is passed the most is the likeliest. See diagnosis_step.cpp.
std::vector<Cause> steps_too_long(const AssembledScene& assembled, const StepSizes& sizes,
                                  const std::vector<ConnectorCell>& cells, const std::vector<ContactPair>& contacts);

/// What no part of a track or vehicle can have, whose figures are likely in other units than SI: waves faster or slower
/// than any solid's, a yield stress that a touch passes, elements of half a metre or of a micrometre. The first part of
/// each kind, each with its one cause. See diagnosis_units.cpp.
std::vector<Fault> absurd_units(const AssembledScene& assembled);

}  // namespace railwave
