#pragma once

#include <fmt/format.h>

#include <vector>

#include "solve/monitor/force_swing.hpp"
#include "solve/monitor/monitor.hpp"
#include "solve/output_schedule.hpp"
#include "solve/step_control.hpp"

namespace railwave {

/// What the time loop itself remembers from one step to the next, and a checkpoint keeps.
struct LoopMemory {
  StepControl control;
  OutputSchedule due;
  std::vector<ForceSwing> swings;
  Monitor monitor;
  double total_at_start = 0;
  long history_rows = 0, field_outputs = 0;
  double elapsed = 0;  ///< s, of the step before

  template <class Archive>
  void archive(Archive& archive) {
    control.archive(archive);
    due.archive(archive);
    std::size_t count = swings.size();
    archive.value("swings", count);
    swings.resize(count);
    for (std::size_t c = 0; c < count; ++c) swings[c].archive(archive, fmt::format("swing_{}", c));
    monitor.archive(archive);
    archive.value("total_at_start", total_at_start);
    archive.value("history_rows", history_rows);
    archive.value("field_outputs", field_outputs);
    archive.value("elapsed", elapsed);
  }
};

}  // namespace railwave
