#include "solve/time_loop.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>

#include "solve/account.hpp"
#include "solve/settle.hpp"
#include "solve/stages.hpp"

namespace railwave {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

/// Steps between looks at the solution where no output asks for one earlier.
constexpr long steps_between_checks = 500;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The whole number of steps nearest to an interval, at least one.
long steps_of(double interval, double step) { return std::max(1L, std::lround(interval / step)); }

/// When the loop has to stop for the outside.
struct Schedule {
  long last, history_every, field_every;

  explicit Schedule(const Model& model)
      : last(model.step_count),
        history_every(steps_of(model.scene.output.history_interval, model.step_size)),
        field_every(model.scene.output.field_interval > 0 ? steps_of(model.scene.output.field_interval, model.step_size) : last) {}

  bool history(long step) const { return step % history_every == 0 || step == last; }
  bool fields(long step) const { return step % field_every == 0 || step == last; }
  bool check(long step) const { return step % steps_between_checks == 0; }
};

/// What is wrong with the solution, or nothing.
std::string fault_in(const HistorySample& sample) {
  if (!std::isfinite(balance_total(sample.energy)))
    return fmt::format("the solution is no longer finite at step {}, t = {:.6g} s; lower time.step_scale, or look for elements "
                       "that are badly shaped or overloaded (`railwave check` names the worst)",
                       sample.step, sample.time);
  return {};
}

void prepare(Model& model, const std::vector<RunObserver*>& observers) {
  if (model.scene.settle.active) {
    const SettleReport report = settle(model, [&](const SettleReport& so_far) {
      for (RunObserver* observer : observers) observer->settling(model, so_far);
      return stop_requested == 0;
    });
    for (RunObserver* observer : observers) observer->settled(model, report);
  }
  set_initial_motion(model);
}

}  // namespace

void request_stop() { stop_requested = 1; }

RunSummary run(Model& model, const std::vector<RunObserver*>& observers) {
  for (RunObserver* observer : observers) observer->begin(model);
  prepare(model, observers);

  const Schedule due(model);
  const auto stages = force_stages(model);
  RunSummary summary;
  summary.step_size = model.step_size;
  summary.left_out = model.left_out;
  double total_at_start = 0;
  const auto began = Clock::now();

  Instant instant;
  instant.step = model.step_size;
  while (true) {
    instant.time = model.time = static_cast<double>(model.step) * model.step_size;
    const bool stopping = stop_requested != 0;
    const bool looked_at = due.history(model.step) || due.fields(model.step) || due.check(model.step) || stopping;
    instant.advancing = !looked_at;
    for (const Stage& stage : stages) stage.run(instant);

    if (looked_at) {
      HistorySample sample = take_sample(model, model.step_size);
      if (model.step == 0) total_at_start = balance_total(sample.energy);
      sample.energy.balance_error = balance_total(sample.energy) - total_at_start;
      summary.reason = fault_in(sample);
      for (RunObserver* observer : observers) {
        if (due.history(model.step) || stopping) observer->history(model, sample);
        if (summary.reason.empty() && (due.fields(model.step) || stopping)) observer->fields(model, sample);
        observer->progress(model, sample);
      }
      if (!summary.reason.empty()) break;
    }
    if (model.step == due.last) break;
    if (stopping) {
      summary.reason = fmt::format("interrupted at step {} of {}, t = {:.6g} s", model.step, due.last, model.time);
      break;
    }
    advance(model, model.step_size);
    instant.elapsed = model.step_size;
  }

  summary.completed = summary.reason.empty();
  summary.time = model.time;
  summary.steps = model.step;
  summary.wall_seconds = seconds_since(began);
  summary.element_steps_per_second =
      static_cast<double>(model.element_count()) * static_cast<double>(model.step) / std::max(summary.wall_seconds, 1e-9);
  for (RunObserver* observer : observers) observer->end(model, summary);
  return summary;
}

}  // namespace railwave
