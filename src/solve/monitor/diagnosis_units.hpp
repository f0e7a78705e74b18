#pragma once

#include <vector>

#include "model/model.hpp"
#include "solve/monitor/fault.hpp"

namespace railwave {

/// What no part of a track or vehicle can have, whose figures are likely in other units than SI: waves faster or slower
/// than any solid's, a yield stress that a touch passes, elements of half a metre or of a micrometre. The first part of
/// each kind, each with its one cause.
std::vector<Fault> absurd_units(const Model& model);

}  // namespace railwave
