#pragma once

#include <algorithm>
#include <chrono>

#include "kernels/support/spaces.hpp"

namespace railwave {

/// Wall time since it was made or last restarted.
class WallClock {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - from_).count(); }
  void restart() { from_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point from_ = Clock::now();
};

/// Wall time of what was timed: pieces of work, or whole steps.
class WorkTiming {
 public:
  void begin() {
    ExecutionSpace().fence();
    clock_.restart();
  }
  void end() {
    ExecutionSpace().fence();
    add(clock_.seconds());
  }
  /// What was timed otherwise.
  void add(double seconds) {
    seconds_ += seconds;
    ++count_;
  }
  double seconds() const { return seconds_; }
  long count() const { return count_; }

 private:
  WallClock clock_;
  double seconds_ = 0;
  long count_ = 0;
};

/// What outputs and the monitor cost a run, s. A step that is sampled costs what it takes beyond a usual step. In a
/// step with an output the monitor costs its own part, and the output the rest.
class SampleTiming {
 public:
  WorkTiming output_steps, monitor_steps, monitor_at_outputs;

  /// @param of_run s, the wall time of all steps
  void finish(double of_run, long steps) {
    const long usual_steps = steps - output_steps.count() - monitor_steps.count();
    const double of_usual_steps = of_run - output_steps.seconds() - monitor_steps.seconds();
    usual_ = usual_steps > 0 ? std::max(0.0, of_usual_steps) / static_cast<double>(usual_steps) : 0;
  }
  double outputs() const { return std::max(0.0, beyond_usual(output_steps) - monitor_at_outputs.seconds()); }
  double monitor() const { return std::max(0.0, beyond_usual(monitor_steps)) + monitor_at_outputs.seconds(); }

 private:
  double beyond_usual(const WorkTiming& steps) const {
    return steps.seconds() - static_cast<double>(steps.count()) * usual_;
  }

  double usual_ = 0;  ///< s, of a step without samples
};

}  // namespace railwave
