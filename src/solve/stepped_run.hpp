#pragma once

#include <memory>
#include <vector>

#include "solve/time_loop.hpp"

namespace railwave {

class TimeLoop;

/// A run that goes on when it is asked to, for programs that do something else in between.
class SteppedRun {
 public:
  /// Settles the scene where it is to, and sets it in motion. All that is passed must outlive this.
  SteppedRun(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled);
  ~SteppedRun();

  /// Takes a step, or as many as nobody looks at. @return false: the run has ended
  bool go_on();

  /// Everything that the run from here on depends on.
  RunState state();
  /// Takes up a state of this run. Throws std::runtime_error where it does not fit the model.
  void take_up(const RunState& state);

  /// To be called when curves or other inputs of the steps to come have been changed.
  void inputs_changed();

  /// s, of the next instant of which observers get a history, should the step stay as it is.
  double next_history() const;

  /// Of a run that has ended.
  RunSummary summary();

 private:
  const std::vector<RunObserver*> observers_;
  const RunKeeping keeping_;
  std::unique_ptr<TimeLoop> loop_;
};

}  // namespace railwave
