#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "model/nodal_state.hpp"
#include "model/time_step/step_sizes.hpp"
#include "solve/observer.hpp"
#include "solve/step_control.hpp"

namespace railwave {

/// At which steps histories and fields are written.
class OutputSchedule {
 public:
  OutputSchedule(const scene::Scene& scene, const NodalState& nodal, const StepSizes& sizes)
      : nodal_(nodal),
        sizes_(sizes),
        history_(sizes.output_times.history, sizes.step_size, nodal.subcycling.cycle()),
        fields_(sizes.output_times.fields, sizes.step_size, nodal.subcycling.cycle()) {
    for (const scene::OutputWindow& window : scene.output_windows)
      windows_.push_back({EverySoOften(window.interval, sizes.step_size, nodal.subcycling.cycle(), window.start),
                          window.end.value_or(std::numeric_limits<double>::infinity())});
  }

  bool last() const { return nodal_.step == sizes_.step_count; }
  bool history() const { return history_.due(nodal_.step) || last(); }
  DueFields fields() const {
    DueFields due_now;
    due_now.all = fields_.due(nodal_.step) || last();
    for (const Window& window : windows_) due_now.windows.push_back(due(window));
    return due_now;
  }

  /// The present step, or the first to come, at which histories are due.
  long next_history() const { return std::min(history_.next(nodal_.step), sizes_.step_count); }

  /// Whether something can be due at a step to come, the step size staying as it is.
  bool any(long step) const {
    return step >= sizes_.step_count || history_.due(step) || fields_.due(step) ||
           std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) { return w.outputs.due(step); });
  }

  /// @param from s, the step size before
  void step_changed(double from) {
    history_.step_changed(nodal_.step, from, sizes_.step_size);
    fields_.step_changed(nodal_.step, from, sizes_.step_size);
    for (Window& window : windows_) window.outputs.step_changed(nodal_.step, from, sizes_.step_size);
  }

  /// See StateSaver.
  template <class Archive>
  void archive(Archive& archive) {
    history_.archive(archive, "history_due");
    fields_.archive(archive, "fields_due");
    for (std::size_t w = 0; w < windows_.size(); ++w)
      windows_[w].outputs.archive(archive, fmt::format("window_{}_due", w));
  }

 private:
  struct Window {
    EverySoOften outputs;
    double end;  ///< s
  };

  /// Rounding of the time stays far below a hundredth of a step.
  bool due(const Window& window) const {
    return window.outputs.due(nodal_.step) && nodal_.time <= window.end + 0.01 * sizes_.step_size;
  }

  const NodalState& nodal_;
  const StepSizes& sizes_;
  EverySoOften history_, fields_;
  std::vector<Window> windows_;
};

}  // namespace railwave
