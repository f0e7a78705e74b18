#include "solve/time_loop.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>

#include "model/doubts.hpp"
#include "model/place_element_sets.hpp"
#include "model/place_sets.hpp"
#include "model/stable_step.hpp"
#include "solve/account.hpp"
#include "solve/contact_window.hpp"
#include "solve/force_swing.hpp"
#include "solve/stages.hpp"
#include "solve/static_start.hpp"
#include "solve/step_control.hpp"
#include "solve/watch.hpp"

namespace railwave {
namespace {

/// Asked for by signal handlers, and by the thread that writes.
std::atomic<int> stop_requested{0};
static_assert(std::atomic<int>::is_always_lock_free);

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// When the loop has to stop for the outside.
class Schedule {
 public:
  explicit Schedule(const Model& model)
      : model_(model),
        history_(model.output_times.history, model.step_size, model.subcycling.round()),
        fields_(model.output_times.fields, model.step_size, model.subcycling.round()) {}

  bool last() const { return model_.step == model_.step_count; }
  bool history() const { return history_.due(model_.step) || last(); }
  bool fields() const { return fields_.due(model_.step) || last(); }

  void step_changed(double from) {
    history_.step_changed(model_.step, from, model_.step_size);
    fields_.step_changed(model_.step, from, model_.step_size);
  }

  template <class Archive>
  void archive(Archive& archive) {
    history_.archive(archive, "history_due");
    fields_.archive(archive, "fields_due");
  }

 private:
  const Model& model_;
  EverySoOften history_, fields_;
};

/// @return whether the run begins in equilibrium
bool prepare(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled,
             const std::function<bool()>& go_on) {
  refuse_moving_held_nodes(model);
  bool in_equilibrium = false;
  if (model.scene.settle.active) {
    const SettleReport report = come_to_rest(model, settled, [&](const SettleReport& so_far) {
      for (RunObserver* observer : observers) observer->settling(model, so_far);
      return go_on();
    });
    for (RunObserver* observer : observers) observer->settled(model, report);
    in_equilibrium = report.settled;
  }
  set_initial_motion(model);
  return in_equilibrium;
}

std::string while_settling(const Model& model, bool out_of_time) {
  const bool kept = model.scene.settle.cache && !model.scene.static_text.empty();
  return std::string(out_of_time ? "the wall time was spent" : "interrupted") + " while the scene settled" +
         (kept ? "; how far it came is kept, and the next run without --restart settles on from there" : "");
}

/// What the loop itself remembers from one step to the next.
struct LoopMemory {
  StepControl control;
  Schedule due;
  std::vector<ForceSwing> swings;
  Watch watch;
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
    watch.archive(archive);
    archive.value("total_at_start", total_at_start);
    archive.value("history_rows", history_rows);
    archive.value("field_outputs", field_outputs);
    archive.value("elapsed", elapsed);
  }
};

/// What looks of the watch cost: a step that nothing else asked to look at, less what a step takes anyhow; where
/// something else did, the watch's own part alone.
class LookTime {
 public:
  void begin() {
    ExecutionSpace().fence();
    from_ = Clock::now();
  }
  void end(bool whole_step) {
    ExecutionSpace().fence();
    seconds_ += seconds_since(from_);
    whole_steps_ += whole_step;
  }
  double seconds(double of_run, long steps) const {
    const long others = steps - whole_steps_;
    const double usual = others > 0 ? std::max(0.0, of_run - seconds_) / static_cast<double>(others) : 0;
    return std::max(0.0, seconds_ - static_cast<double>(whole_steps_) * usual);
  }

 private:
  Clock::time_point from_;
  double seconds_ = 0;
  long whole_steps_ = 0;
};

/// When states are kept and when the wall time is spent.
class Keeper {
 public:
  explicit Keeper(const RunKeeping& keeping) : keeping_(keeping), began_(Clock::now()), last_(began_) {}

  bool out_of_time() const { return keeping_.time_left > 0 && seconds_since(began_) >= keeping_.time_left; }
  bool due() const {
    return keeping_.checkpoints && keeping_.interval > 0 && seconds_since(last_) >= keeping_.interval;
  }

  void keep(Model& model, LoopMemory& memory, RunSummary& summary) {
    if (!keeping_.checkpoints) return;
    const auto from = Clock::now();
    RunState state;
    take_model_state(model, state);
    StateTaker taker(state);
    memory.archive(taker);
    state.history_rows = memory.history_rows;
    state.field_outputs = memory.field_outputs;
    keeping_.checkpoints->keep(std::move(state));
    ++summary.checkpoints;
    last_ = Clock::now();
    summary.checkpoint_seconds += std::chrono::duration<double>(last_ - from).count();
  }

 private:
  const RunKeeping& keeping_;
  Clock::time_point began_, last_;
};

}  // namespace

void request_stop() { stop_requested = 1; }

RunSummary run(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled,
               const RunKeeping& keeping) {
  Keeper keeper(keeping);
  for (RunObserver* observer : observers) observer->begin(model);
  const std::vector<std::string> doubts = scene_doubts(model);
  for (RunObserver* observer : observers) observer->doubts(doubts);
  const auto go_on = [&] { return stop_requested == 0 && !keeper.out_of_time(); };
  const bool in_equilibrium = keeping.from || prepare(model, observers, settled, go_on);
  const bool prepared = keeping.from || !model.scene.settle.active || go_on();

  LoopMemory memory{StepControl(model), Schedule(model),
                    std::vector<ForceSwing>(in_equilibrium ? 0 : model.scene.contacts.size()), Watch(model)};
  auto& [control, due, swings, watch, total_at_start, history_rows, field_outputs, elapsed] = memory;
  const auto stages = force_stages(model);
  if (keeping.from) {
    lay_model_state(model, *keeping.from);
    StateLayer layer(*keeping.from);
    memory.archive(layer);
    control.move_end();
  }
  RunSummary summary;
  summary.left_out = model.left_out;
  summary.first_step = model.step;
  const auto began = Clock::now();
  LookTime looks;

  Instant instant;
  instant.elapsed = elapsed;
  while (true) {
    bool stopping = false;
    instant.time = model.time = control.time();  // before a state is kept: it tells the time of its step
    if (model.subcycling.in_phase(model.step)) {
      summary.out_of_time = keeper.out_of_time();
      stopping = summary.out_of_time || stop_requested != 0;
      // A scene that was stopped while it settled has nothing to go on from.
      const bool worth_it = prepared && model.step > summary.first_step;
      if (worth_it && (due.last() ? keeping.at_end : stopping || keeper.due())) keeper.keep(model, memory, summary);
    }
    const double step_before = model.step_size;
    if (control.renew()) due.step_changed(step_before);
    instant.step = model.step_size;
    const bool asked_for = due.history() || due.fields() || stopping;
    // A run that goes on with a model that has run before begins at a later step.
    const bool first = !keeping.from && model.step == summary.first_step;
    const bool looked_at = asked_for || first || (watch.due(model.step) && model.subcycling.in_phase(model.step));
    instant.advancing = !looked_at;
    if (looked_at && !asked_for) looks.begin();
    for (const Stage& stage : stages) stage.run(instant);
    watch.glance();

    if (looked_at) {
      HistorySample sample =
          (asked_for ? take_sample : take_look)(model, model.step_size, watch.part_energies(model.step));
      if (first) total_at_start = balance_total(sample.energy);
      sample.energy.balance_error = balance_total(sample.energy) - total_at_start;
      if (asked_for) looks.begin();
      const std::vector<Fault> found = watch.look(sample);
      if (asked_for) looks.end(false);
      for (const Fault& fault : found)
        for (RunObserver* observer : observers) observer->warning(model, fault);
      if (const Fault* fault = watch.fatal()) {
        summary.fault = *fault;
        summary.reason = fault->told();
      }
      const bool broken = summary.fault.has_value();
      if (broken && !asked_for) add_what_histories_tell(model, sample);
      for (std::size_t c = 0; c < swings.size(); ++c) swings[c].add(sample.time, sample.contacts[c].normal_force);
      for (RunObserver* observer : observers) {
        if (due.history() || stopping || broken) observer->history(model, sample);
        if (due.fields() || stopping || broken) observer->fields(model, sample);
        observer->progress(model, sample);
      }
      if (broken) break;
      if (due.history()) ++history_rows;
      if (due.fields()) ++field_outputs;
    }
    if (due.last()) break;
    if (stopping) {
      if (!prepared)
        summary.reason = while_settling(model, summary.out_of_time);
      else
        summary.reason = fmt::format("{} at step {} of {}, t = {:.6g} s",
                                     summary.out_of_time ? "the wall time is spent" : "interrupted", model.step,
                                     model.step_count, model.time);
      break;
    }
    advance(model, model.step_size);
    instant.elapsed = elapsed = model.step_size;
    if (looked_at && !asked_for) looks.end(true);
  }

  summary.step_size = model.step_size;
  summary.smallest_step = control.smallest();
  summary.largest_step = control.largest();
  summary.step_renewals = control.renewals();
  summary.step_estimates = describe_stable_step(model);
  summary.subcycling = describe_subcycling(model);
  summary.warnings = watch.told();
  summary.account = watch.account_told();
  summary.watched = watch.worst_told();
  for (const std::string& apart : watch.never_closed()) summary.warnings.push_back(apart);
  for (const std::string& late : late_contacts(model)) summary.warnings.push_back(late);
  if (keeping.checkpoints)
    if (const std::string trouble = keeping.checkpoints->trouble(); !trouble.empty())
      summary.warnings.push_back(trouble);
  for (const PlacedSet& placed : placed_sets(model.scene, model.assembly))
    if (!placed.warning.empty()) summary.warnings.push_back(placed.warning);
  summary.warnings.insert(summary.warnings.end(), doubts.begin(), doubts.end());
  for (const PlacedElements& placed : placed_element_sets(model.scene, model.assembly))
    if (!placed.warning.empty()) summary.warnings.push_back(placed.warning);
  for (std::size_t c = 0; c < swings.size(); ++c)
    if (const std::string told = swings[c].told(model.scene.contacts[c].name); !told.empty())
      summary.swings.push_back(told);
  summary.completed = summary.reason.empty();
  summary.time = model.time;
  summary.steps = model.step;
  summary.wall_seconds = seconds_since(began);
  summary.watch_seconds =
      looks.seconds(summary.wall_seconds - summary.checkpoint_seconds, model.step - summary.first_step);
  const double updates = static_cast<double>(model.element_count()) *
                         static_cast<double>(model.step - summary.first_step) / model.subcycling.gain();
  summary.element_steps_per_second = updates / std::max(summary.wall_seconds, 1e-9);
  for (RunObserver* observer : observers) observer->end(model, summary);
  return summary;
}

}  // namespace railwave
