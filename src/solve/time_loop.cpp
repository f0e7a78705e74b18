#include "solve/time_loop.hpp"

#include "solve/loop.hpp"
#include "solve/stepped_run.hpp"

namespace railwave {

RunSummary run(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled,
               const RunKeeping& keeping) {
  TimeLoop loop(model, observers, settled, keeping);
  while (loop.go_on()) {
  }
  return loop.summary();
}

SteppedRun::SteppedRun(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled)
    : observers_(observers), loop_(std::make_unique<TimeLoop>(model, observers_, settled, keeping_)) {}

SteppedRun::~SteppedRun() = default;

bool SteppedRun::go_on() { return loop_->go_on(); }

RunState SteppedRun::state() { return loop_->state(); }

void SteppedRun::take_up(const RunState& state) {
  loop_->inputs_changed();
  loop_->take_up(state);
}

void SteppedRun::inputs_changed() { loop_->inputs_changed(); }

double SteppedRun::next_history() const { return loop_->next_history(); }

RunSummary SteppedRun::summary() { return loop_->summary(); }

}  // namespace railwave
