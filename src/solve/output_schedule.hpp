#pragma once

#include "model/nodal_state.hpp"
#include "model/time_step/step_sizes.hpp"
#include "solve/step_control.hpp"

namespace railwave {

/// At which steps histories and fields are written.
class OutputSchedule {
 public:
  OutputSchedule(const NodalState& nodal, const StepSizes& sizes)
      : nodal_(nodal),
        sizes_(sizes),
        history_(sizes.output_times.history, sizes.step_size, nodal.subcycling.cycle()),
        fields_(sizes.output_times.fields, sizes.step_size, nodal.subcycling.cycle()) {}

  bool last() const { return nodal_.step == sizes_.step_count; }
  bool history() const { return history_.due(nodal_.step) || last(); }
  bool fields() const { return fields_.due(nodal_.step) || last(); }

  /// @param from s, the step size before
  void step_changed(double from) {
    history_.step_changed(nodal_.step, from, sizes_.step_size);
    fields_.step_changed(nodal_.step, from, sizes_.step_size);
  }

  /// See StateSaver.
  template <class Archive>
  void archive(Archive& archive) {
    history_.archive(archive, "history_due");
    fields_.archive(archive, "fields_due");
  }

 private:
  const NodalState& nodal_;
  const StepSizes& sizes_;
  EverySoOften history_, fields_;
};

}  // namespace railwave
