#pragma once

#include <vector>

#include "model/model.hpp"
#include "solve/monitor/fault.hpp"

namespace railwave {

/// The name of a cause that may be one only where a body is one element thick.
inline constexpr const char* possible_step_cause = "step beyond elements alone";

/// For each of elements, hourglass control, contact springs, connectors and beams that the run's step is too long for:
/// by how much, who it is, and the mend. The one that is passed the most is the likeliest.
std::vector<Cause> steps_too_long(const Model& model);

}  // namespace railwave
