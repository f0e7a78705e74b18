#pragma once

#include <vector>

#include "kernels/support/reductions.hpp"
#include "model/model.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// What each of the scene's loads comes to at the present instant, into `totals` when the sums are fetched.
void queue_load_totals(const Model& model, std::vector<LoadTotals>& totals, Reductions& sums);

}  // namespace railwave
