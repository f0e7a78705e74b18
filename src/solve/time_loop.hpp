#pragma once

#include <vector>

#include "model/model.hpp"
#include "solve/observer.hpp"
#include "solve/static_state.hpp"

namespace railwave {

/// Runs a model from rest, or from its settled state, to the scene's end (thesis table 2.1) and tells the observers.
/// Ends early when interrupted (`request_stop`) or when the watch finds something fatal; the summary says which.
/// @param settled where settled states are kept; null: nowhere
RunSummary run(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled = nullptr);

/// Asks the running time loop to stop after the present step. Safe in a signal handler.
void request_stop();

}  // namespace railwave
