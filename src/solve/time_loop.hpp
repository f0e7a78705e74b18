#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "solve/checkpoint/run_state.hpp"
#include "solve/observer.hpp"
#include "solve/statics/static_state.hpp"

namespace railwave {

class Transport;

/// How a run is kept against its end, and from where it goes on.
struct RunKeeping {
  Checkpoints* checkpoints = nullptr;  ///< where states are kept; null: nowhere
  double interval = 0;                 ///< wall seconds between two; 0: only where the run is stopped from outside
  bool at_end = false;                 ///< also at the end, from which a run with a later end can go on
  double time_left = 0;                ///< wall seconds after which it stops; 0: no such budget
  const RunState* from = nullptr;      ///< a state of this very run to go on from; null: from the start
  Transport* transport = nullptr;      ///< to other ranks, which follow this one (solve/ranks); null: there are none
};

/// Runs a model from rest, or from its settled state, to the scene's end (thesis table 2.1) and tells the observers.
/// Ends early when interrupted (`request_stop`) or when the monitor finds something fatal; the summary says which.
/// @param settled where settled states are kept; null: nowhere
/// @param keeping throws std::runtime_error where the state to go on from does not fit the model
RunSummary run(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled = nullptr,
               const RunKeeping& keeping = {});

/// One of several runs that take turns.
struct EnsembleMember {
  Model* model;
  std::vector<RunObserver*> observers;
  SettledStates* settled = nullptr;
  RunKeeping keeping = {};
};

/// What became of it.
struct RunOutcome {
  std::optional<RunSummary> summary;
  std::string error;  ///< without a summary: what was thrown
};

/// Runs several models, each with its own clock, observers and end: it becomes what it would by itself, bit for bit,
/// and what goes wrong with one ends no other. They settle one after the other; then they begin, each some steps after
/// the one before it, and take a step, or the steps of a graph, in turn. On a GPU graphs of different members run side
/// by side, each in an order of its own, and who has some at work or waits for a sample is passed over.
std::vector<RunOutcome> run_together(const std::vector<EnsembleMember>& members);

/// Asks the running time loop to stop after the present step. Safe in a signal handler.
void request_stop();

}  // namespace railwave
