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

/// What the monitor costs a run. A step that is sampled for the monitor alone costs what it takes beyond a usual step;
/// where a sample was due anyhow, the monitor costs its own part.
class MonitorTiming {
 public:
  void begin() {
    ExecutionSpace().fence();
    clock_.restart();
  }
  void end(bool whole_step) {
    ExecutionSpace().fence();
    seconds_ += clock_.seconds();
    whole_steps_ += whole_step;
  }
  /// @param of_run s, the wall time of all steps
  double seconds(double of_run, long steps) const {
    const long others = steps - whole_steps_;
    const double usual = others > 0 ? std::max(0.0, of_run - seconds_) / static_cast<double>(others) : 0;
    return std::max(0.0, seconds_ - static_cast<double>(whole_steps_) * usual);
  }

 private:
  WallClock clock_;
  double seconds_ = 0;
  long whole_steps_ = 0;
};

}  // namespace railwave
