#pragma once

#include <vector>

#include "model/model.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// What each of the scene's loads comes to at the present instant.
std::vector<LoadTotals> load_totals(const Model& model);

}  // namespace railwave
