#pragma once

#include "model/model.hpp"
#include "solve/step_control.hpp"

namespace railwave {

/// At which steps histories and fields are written.
class OutputSchedule {
 public:
  explicit OutputSchedule(const Model& model)
      : model_(model),
        history_(model.output_times.history, model.step_size, model.subcycling.round()),
        fields_(model.output_times.fields, model.step_size, model.subcycling.round()) {}

  bool last() const { return model_.step == model_.step_count; }
  bool history() const { return history_.due(model_.step) || last(); }
  bool fields() const { return fields_.due(model_.step) || last(); }

  /// @param from s, the step size before
  void step_changed(double from) {
    history_.step_changed(model_.step, from, model_.step_size);
    fields_.step_changed(model_.step, from, model_.step_size);
  }

  /// See StateTaker.
  template <class Archive>
  void archive(Archive& archive) {
    history_.archive(archive, "history_due");
    fields_.archive(archive, "fields_due");
  }

 private:
  const Model& model_;
  EverySoOften history_, fields_;
};

}  // namespace railwave
