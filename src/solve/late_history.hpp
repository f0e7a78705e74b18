#pragma once

#include <memory>

#include "kernels/support/milestone.hpp"
#include "solve/monitor/account.hpp"
#include "solve/run_timing.hpp"

namespace railwave {

/// A history for which nobody waits on a GPU: its sums come to the host while the device takes the next steps, and
/// before any step that may be sampled because of it.
class LateHistory {
 public:
  /// Before the forces of its instant are launched.
  void announce() { begins_.put(ExecutionSpace()); }

  /// Launches the sums of that instant.
  /// @param step s, to the next instant
  /// @param energies_summed whether the tasks of energy_sum_tasks() have run
  void begin(const Model& model, double step, bool energies_summed) {
    sample_ = std::make_unique<SampleUnderWay>(model, step, energies_summed);
  }

  /// Behind the step's motion.
  void send() { sample_->send(ends_); }

  bool under_way() const { return sample_ != nullptr; }

  /// Waits for it. Nothing else of the model may have been sampled since.
  /// @param timing of the device's time for it, from its instant on
  HistorySample finish(WorkTiming& timing) {
    begins_.wait();
    const WallClock clock;
    HistorySample sample = sample_->finish(ends_);
    timing.add(clock.seconds());
    sample_.reset();
    return sample;
  }

 private:
  Milestone begins_, ends_;
  std::unique_ptr<SampleUnderWay> sample_;  ///< null: none is under way
};

}  // namespace railwave
