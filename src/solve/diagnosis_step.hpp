#pragma once

#include <vector>

#include "model/model.hpp"
#include "solve/fault.hpp"

namespace railwave {

/// For each of elements, hourglass control, contact springs, connectors and beams that the run's step is too long for: by how
/// much, who it is, and the mend. The one that is passed the most is the likeliest.
std::vector<Cause> steps_too_long(const Model& model);

}  // namespace railwave
