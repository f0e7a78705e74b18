#include "solve/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "model/elements/carriers.hpp"
#include "model/host_copy.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

/// Share by which the step must be able to grow before it does: every change moves the outputs by a part of a step.
constexpr double worthwhile_gain = 0.01;

/// Steps between looks for slave nodes that touch although the estimate did not predict it.
constexpr long steps_between_looks = 500;

/// Steps in the whole number of rounds nearest to an interval, at least one round.
long whole_rounds(double interval, double step, long round) {
  return std::max(1L, std::lround(interval / (static_cast<double>(round) * step))) * round;
}

}  // namespace

StepControl::StepControl(Model& model) : model_(model) {
  // Settled and set in motion, the bodies may be about to touch elsewhere than as they were placed.
  if (model.global_estimate && !model.contacts.empty()) {
    renew_global_step(model);
    plan();
    ++renewals_;
  }
  smallest_ = largest_ = model.step_size;
}

double StepControl::time() const {
  return begin_time_ + static_cast<double>(model_.step - begin_step_) * model_.step_size;
}

bool StepControl::touched_unseen() const {
  for (std::size_t p = 0; p < model_.contacts.size(); ++p) {
    const auto status = to_host(model_.contacts[p].arrays.status);
    const auto& seen = model_.stable_step.seen[p];
    for (std::size_t s = 0; s < seen.size(); ++s)
      if (!seen[s] && status(static_cast<int>(s)) != status_apart) return true;
  }
  return false;
}

bool StepControl::due() const {
  const int every = model_.scene.solver.renew_steps;
  if (!model_.global_estimate || every == 0 || model_.step == renewed_at_) return false;
  if (model_.step - renewed_at_ >= every) return true;
  return model_.step % steps_between_looks == 0 && touched_unseen();
}

/// Whole steps from the present instant to the end; whether they are others than planned before.
bool StepControl::plan() {
  const double left = model_.scene.time.end - model_.time;
  const long planned = model_.step_count - model_.step;
  const long steps = std::max(1L, static_cast<long>(std::ceil(left / largest_step(model_) - 1e-9)));
  // At the beginning the outputs can still be laid evenly.
  if (model_.step == 0) {
    const long before = model_.step_count;
    plan_steps(model_, 1);
    begin_time_ = 0;
    begin_step_ = 0;
    return model_.step_count != before;
  }
  if (steps <= planned && static_cast<double>(planned) <= (1 + worthwhile_gain) * static_cast<double>(steps))
    return false;
  begin_time_ = model_.time;
  begin_step_ = model_.step;
  model_.step_size = left / static_cast<double>(steps);
  model_.step_count = model_.step + steps;
  return true;
}

void StepControl::move_end() {
  const double end = model_.scene.time.end, now = time(), step = model_.step_size;
  if (now > end + 1e-6 * step)
    throw InputError(
        fmt::format("time.end: the checkpoint's t = {:.6g} s lies beyond {:.6g} s; name a later end, or run the case "
                    "without --restart",
                    now, end));
  const auto round = static_cast<double>(model_.subcycling.round());
  model_.step_count = model_.step + static_cast<long>(round * std::ceil((end - now) / (round * step) - 1e-6));
}

bool StepControl::renew() {
  if (!due() || model_.step == model_.step_count) return false;
  if (model_.carried.begun) give_nodes_back(model_);
  renew_global_step(model_);
  ++renewals_;
  renewed_at_ = model_.step;
  const bool changed = plan();
  smallest_ = std::min(smallest_, model_.step_size);
  largest_ = std::max(largest_, model_.step_size);
  return changed;
}

EverySoOften::EverySoOften(double interval, double step, long round)
    : interval_(interval), round_(round), every_(whole_rounds(interval, step, round)) {}

void EverySoOften::step_changed(long step, double old_size, double new_size) {
  const long missing = step < next_ ? next_ - step : (every_ - (step - next_) % every_) % every_;
  next_ = missing == 0 ? step : step + whole_rounds(static_cast<double>(missing) * old_size, new_size, round_);
  every_ = whole_rounds(interval_, new_size, round_);
}

}  // namespace railwave
