#pragma once

#include <string>
#include <vector>

#include "model/contact/contact_pair.hpp"
#include "model/nodal_state.hpp"
#include "model/time_step/step_sizes.hpp"
#include "solve/deformed_step.hpp"

namespace railwave {

/// The run's step as it goes: whole steps of one size to the end, until a renewed estimate of the stable step asks for
/// others. Time is that of the last change plus whole steps since, so a step that never changes leaves no rounding
/// behind.
class StepControl {
 public:
  /// The model stands at its first step, its present motion known.
  /// @param elements those of this process, whose deformation the step follows
  /// @param others of a run over several ranks; null: there are none
  StepControl(Model& model, DeformedElements elements, SampledRanks* others);

  /// Time of the model's present step, s.
  double time() const { return time_of(nodal_.step); }
  /// Of a step to come too, the step size staying as it is.
  double time_of(long step) const { return begin_time_ + static_cast<double>(step - begin_step_) * sizes_.step_size; }
  long last_step() const { return sizes_.step_count; }

  /// Looks at the elements where that is due; call once a step, before due() and renew().
  void check_elements() { deformed_due_ = deformed_.check(); }

  /// Whether the estimate is to be renewed now: then it looks at the whole model.
  bool due() const;

  /// Whether the present step looks at the model: at its elements, or for another estimate.
  bool looks_at_model() const;

  /// Whether it does so for another estimate, which takes as long as hundreds of steps.
  bool may_search() const;

  /// Renews the estimate where that is due, and follows deformed elements; call before the forces of the present
  /// instant, which move nodes already. True: the step from this instant to the next is another one than the last.
  bool renew();

  /// Whether the present step begins with what waits for the device.
  bool would_wait() const;

  /// Whether the step can change at a step to come.
  bool may_renew(long step) const { return deformed_.due(step) || may_renew_estimate(step); }

  /// For a state that was taken up: where the scene now ends elsewhere than that state's run was to, the steps stay as
  /// they are and go on to the first whole cycle at that end or after it. Throws InputError where the state lies beyond
  /// the end.
  void move_end();

  int renewals() const { return renewals_; }
  double smallest() const { return smallest_; }
  double largest() const { return largest_; }

  /// See StateSaver.
  template <class Archive>
  void archive(Archive& archive) {
    archive.value("control_begin_time", begin_time_);
    archive.value("control_begin_step", begin_step_);
    archive.value("control_renewed_at", renewed_at_);
    archive.value("control_renewals", renewals_);
    archive.value("control_smallest", smallest_);
    archive.value("control_largest", largest_);
    deformed_.archive(archive);
  }

 private:
  bool automatic() const;  ///< the step chooses itself
  bool interval_over(long step) const;
  bool may_renew_estimate(long step) const;
  void follow_elements();
  void find_step();
  bool touched_unseen() const;
  bool plan();

  const scene::Scene& scene_;
  const NodalState& nodal_;
  const std::vector<ContactPair>& contacts_;
  StepSizes& sizes_;
  double begin_time_ = 0;  ///< s, when the present step size came in
  long begin_step_ = 0;
  long renewed_at_ = 0;
  int renewals_ = 0;
  double smallest_ = 0, largest_ = 0;
  DeformedStep deformed_;
  bool deformed_due_ = false;  ///< at the present step
};

/// Something due about every `interval` seconds, at steps: `interval` rounded to whole cycles of steps (at least one)
/// and counted from the start, or from where a change of step left it, so that it keeps its times.
class EverySoOften {
 public:
  /// @param interval s; 0: every cycle
  /// @param cycle steps: 1, or those between two instants at which all is in phase
  /// @param start s: due first at the first cycle that begins then or later
  EverySoOften(double interval, double step, long cycle = 1, double start = 0);
  bool due(long step) const { return step >= next_ && (step - next_) % every_ == 0; }
  /// The first step from the given one on at which it is due.
  long next(long step) const { return step <= next_ ? next_ : step + (every_ - (step - next_) % every_) % every_; }
  /// From `step` on; what is due at that very step stays due.
  void step_changed(long step, double old_size, double new_size);

  /// See StateSaver.
  template <class Archive>
  void archive(Archive& archive, const std::string& name) {
    archive.value(name + "_every", every_);
    archive.value(name + "_next", next_);
  }

 private:
  double interval_;
  long cycle_, every_, next_ = 0;
};

}  // namespace railwave
