#include "solve/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "model/elements/relative_coordinates.hpp"
#include "model/host_copy.hpp"
#include "model/output_times.hpp"
#include "model/time_step/automatic_step.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

/// Share by which the step must be able to grow before it does: every change moves the outputs by a part of a step.
constexpr double worthwhile_gain = 0.01;

/// Share of a time that rounding may take.
constexpr double rounding = 1e-9;

/// Steps between checks for slave nodes that touch although the estimate did not predict it.
constexpr long steps_between_checks = 500;

}  // namespace

StepControl::StepControl(Model& model, DeformedElements elements, SampledRanks* others)
    : scene_(model.scene),
      nodal_(model),
      contacts_(model.contacts),
      sizes_(model),
      deformed_(model, std::move(elements), others) {
  // Settled and set in motion, the bodies may be about to touch elsewhere than as they were placed.
  if (sizes_.global_estimate && (automatic() ? has_contact_springs(contacts_) : !contacts_.empty())) {
    find_step();
    plan();
    ++renewals_;
  }
  smallest_ = largest_ = sizes_.step_size;
}

bool StepControl::touched_unseen() const {
  for (std::size_t p = 0; p < contacts_.size(); ++p) {
    const auto status = to_host(contacts_[p].arrays.status);
    const auto& seen = sizes_.stable_step.seen[p];
    for (std::size_t s = 0; s < seen.size(); ++s)
      if (!seen[s] && status(static_cast<int>(s)) != status_apart) return true;
  }
  return false;
}

void StepControl::find_step() {
  sizes_.stable_step.deformed = 0;
  if (automatic())
    renew_automatic_step(scene_, contacts_, nodal_.time, nodal_.step, sizes_);
  else
    renew_global_step(scene_, contacts_, nodal_.time, sizes_);
  deformed_.estimated();
}

bool StepControl::automatic() const { return scene_.solver.step_estimate == scene::StepEstimate::automatic; }

bool StepControl::interval_over(long step) const {
  const int every = scene_.solver.renew_steps;
  return every > 0 && step - renewed_at_ >= every;
}

bool StepControl::may_renew_estimate(long step) const {
  if (!sizes_.global_estimate || step == renewed_at_) return false;
  if (automatic()) return can_change(scene_, contacts_) && (interval_over(step) || contact_answers(contacts_, step));
  return scene_.solver.renew_steps > 0 && (interval_over(step) || step % steps_between_checks == 0);
}

bool StepControl::due() const {
  const long step = nodal_.step;
  if (!may_renew_estimate(step)) return false;
  if (!automatic()) return interval_over(step) || touched_unseen();
  return may_touch_uncounted(contacts_, step) ||
         (interval_over(step) && may_search_again(scene_, sizes_, nodal_.time, step));
}

bool StepControl::looks_at_model() const { return deformed_.due(nodal_.step) || may_search(); }

bool StepControl::would_wait() const {
  const long step = nodal_.step;
  return deformed_.due(step) ||
         (may_renew_estimate(step) && (!automatic() || interval_over(step) || !contact_has_answered(contacts_, step)));
}

bool StepControl::may_search() const {
  // Unless the step is chosen automatically, due() itself looks.
  return automatic() ? due() : may_renew_estimate(nodal_.step);
}

/// Whole steps from the present instant to the end; whether they are others than planned before.
bool StepControl::plan() {
  const double left = scene_.time.end - nodal_.time;
  const long planned = sizes_.step_count - nodal_.step;
  const double largest_now = largest_step(scene_.time, sizes_.stable_step);
  const long cycle = nodal_.subcycling.cycle();
  const long steps =
      std::max(1L, static_cast<long>(std::ceil(left / (static_cast<double>(cycle) * largest_now) - 1e-9))) * cycle;
  // At the beginning the outputs can still be spaced evenly.
  if (nodal_.step == 0) {
    const long before = sizes_.step_count;
    plan_steps(scene_, cycle, sizes_);
    begin_time_ = 0;
    begin_step_ = 0;
    return sizes_.step_count != before;
  }
  if (steps <= planned && static_cast<double>(planned) <= (1 + worthwhile_gain) * static_cast<double>(steps))
    return false;
  begin_time_ = nodal_.time;
  begin_step_ = nodal_.step;
  sizes_.step_size = left / static_cast<double>(steps);
  sizes_.step_count = nodal_.step + steps;
  return true;
}

void StepControl::move_end() {
  const double end = scene_.time.end, now = time(), step = sizes_.step_size;
  if (now > end + 1e-6 * step)
    throw InputError(
        fmt::format("time.end: the checkpoint's t = {:.6g} s lies beyond {:.6g} s; name a later end, or run the case "
                    "without --restart",
                    now, end));
  const auto cycle = static_cast<double>(nodal_.subcycling.cycle());
  sizes_.step_count = nodal_.step + static_cast<long>(cycle * std::ceil((end - now) / (cycle * step) - 1e-6));
}

void StepControl::follow_elements() {
  if (automatic() && sizes_.global_estimate && deformed_.by_elements()) {
    leave_whole_scene(StepChoice::Reason::deforms, sizes_);
    deformed_.estimated();
  }
  deformed_.set(sizes_.stable_step);
}

bool StepControl::renew() {
  const bool search = due();
  if ((!search && !deformed_due_) || nodal_.step == sizes_.step_count) return false;
  if (search) {
    if (nodal_.relative.begun) update_absolute_nodes(nodal_);
    find_step();
    renewed_at_ = nodal_.step;
    deformed_due_ = deformed_.check_again();
  }
  if (deformed_due_) follow_elements();
  ++renewals_;
  const bool changed = plan();
  smallest_ = std::min(smallest_, sizes_.step_size);
  largest_ = std::max(largest_, sizes_.step_size);
  return changed;
}

EverySoOften::EverySoOften(double interval, double step, long cycle, double start)
    : interval_(interval),
      cycle_(cycle),
      every_(whole_cycles(interval, step, cycle)),
      next_(static_cast<long>(std::ceil(start / (static_cast<double>(cycle) * step) * (1 - rounding))) * cycle) {}

void EverySoOften::step_changed(long step, double old_size, double new_size) {
  const long missing = step < next_ ? next_ - step : (every_ - (step - next_) % every_) % every_;
  next_ = missing == 0 ? step : step + whole_cycles(static_cast<double>(missing) * old_size, new_size, cycle_);
  every_ = whole_cycles(interval_, new_size, cycle_);
}

}  // namespace railwave
