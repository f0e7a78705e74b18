#pragma once

#include <memory>

#include "kernels/support/milestone.hpp"
#include "solve/monitor/account.hpp"
#include "solve/run_timing.hpp"

namespace railwave {

/// A sample for which nobody waits on a GPU: its sums come to the host while the device takes the next steps, and
/// before any step that may be sampled because of it.
class LateSample {
 public:
  /// Before the forces of its instant are launched.
  void announce() { begins_.put(ExecutionSpace()); }

  /// Launches the sums of that instant.
  /// @param step s, to the next instant
  void begin(const Model& model, double step, const SampleUnderWay::What& what) {
    sample_ = std::make_unique<SampleUnderWay>(model, step, what);
    is_history_ = what.histories;
  }

  /// Behind the step's motion.
  void send() { sample_->send(ends_); }

  bool under_way() const { return sample_ != nullptr; }
  /// Whether it has more than the monitor asks for.
  bool is_history() const { return is_history_; }

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
  bool is_history_ = false;
  std::unique_ptr<SampleUnderWay> sample_;  ///< null: none is under way
};

}  // namespace railwave
