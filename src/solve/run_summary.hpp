#pragma once

#include <vector>

#include "solve/monitor/force_swing.hpp"
#include "solve/monitor/watch.hpp"
#include "solve/observer.hpp"
#include "solve/step_control.hpp"

namespace railwave {

/// Completes the summary of a run that has ended: steps, estimates of the stable step, account, warnings. The summary
/// holds already what the time loop knows: why the run ended, its fault, wall time and checkpoints.
/// @param doubts lines that were reported when the run began
void summarize_run(const Model& model, const StepControl& control, const Watch& watch,
                   const std::vector<ForceSwing>& swings, const std::vector<std::string>& doubts, RunSummary& summary);

}  // namespace railwave
