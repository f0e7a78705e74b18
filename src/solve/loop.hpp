#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/memory.hpp"
#include "model/checks/doubts.hpp"
#include "solve/late_sample.hpp"
#include "solve/launch_order.hpp"
#include "solve/loop_memory.hpp"
#include "solve/monitor/account.hpp"
#include "solve/plan.hpp"
#include "solve/ranks/rank_team.hpp"
#include "solve/run_summary.hpp"
#include "solve/run_timing.hpp"
#include "solve/step_recording.hpp"
#include "solve/time_loop.hpp"

namespace railwave {

/// Whether request_stop() has been called.
bool stop_is_requested();

/// Settles the scene where it is to, and sets it in motion. @return whether it begins in equilibrium
bool prepare(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled, Transport* others,
             const std::function<bool()>& go_on);

/// Why a run ends that was stopped before its first step.
std::string while_settling(const scene::Scene& scene, bool out_of_time);

/// A run from its beginning, or from a checkpoint, to its end (thesis table 2.1).
class TimeLoop {
 public:
  /// @param space of the run's launches, where other runs go on meanwhile; null: the default one
  TimeLoop(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled, const RunKeeping& keeping,
           const ExecutionSpace* space = nullptr)
      : order_(space),
        model_(model),
        observers_(observers),
        keeping_(keeping),
        doubts_(report_beginning()),
        in_equilibrium_(keeping.from ||
                        prepare(model, observers, settled, keeping.transport, [this] { return may_go_on(); })),
        prepared_(keeping.from || !model.scene.settle.active || may_go_on()),
        as_made_(model),
        leader_(keeping.transport ? std::make_unique<RankLeader>(model, *keeping.transport) : nullptr),
        memory_{StepControl(model, deformed_elements(model, leader_ ? &leader_->own() : nullptr), leader_.get()),
                OutputSchedule(model.scene, model, model),
                std::vector<ForceSwing>(in_equilibrium_ ? 0 : model.scene.contacts.size()),
                Monitor(model, model, model, model, model.contacts, as_made_, leader_ ? &leader_->own() : nullptr,
                        leader_.get())},
        plans_(model, leader_ ? &leader_->exchange() : nullptr),
        recording_(model, plans_.of(StepKind::advancing), order_, leader_ ? &leader_->exchange() : nullptr),
        sampled_forces_(model, {plans_.of(StepKind::sampled).forces, energy_sum_tasks(model)}, order_),
        answers_may_be_late_(!order_.own() && !leader_ && recording_.most() > 0 &&
                             std::none_of(observers.begin(), observers.end(),
                                          [](const RunObserver* one) { return one->looks_at_model(); })) {
    if (keeping.from) take_up(*keeping.from);
    summary_.first_step = model.step;
    if (leader_) leader_->begin(keeping.from == nullptr);
  }

  /// Takes a step, or the steps of a graph. In an order of its own what a step asks of the device comes while others go
  /// on, and the step is finished by the next call. @return false: the run has ended
  bool go_on() {
    if (asked_) return finish_step();
    if (!begun_) since_first_step_.restart();
    begun_ = true;
    // What the monitor finds in it decides what is due.
    if (model_.step % Monitor::steps_when_odd == 0 || !quiet(model_.step)) finish_late();
    begin_step();
    checkpoint_if_due();
    plan_step();
    if (leader_ ? take_shared_steps() : take_recorded_steps()) return true;
    finish_late();
    if (order_.own())
      order_.enter();
    else
      recording_.finish(!late_);
    if (leader_) leader_->sample(instant_);
    const bool energies_summed = samples_energies() && !leader_ && record_sampled_forces();
    if (!energies_summed)
      plans_.compute_forces(in_order(), sampled_ || asks_for_places() ? StepKind::sampled : StepKind::advancing);
    wait_for_other_ranks();
    if (late_)
      ask_late(energies_summed);
    else if (!leader_)
      ask(energies_summed);
    return order_.own() || finish_step();
  }

  /// The present state, between two steps.
  RunState state() {
    finish_late();
    recording_.finish();
    if (leader_) leader_->gather();
    RunState state;
    save_model_state(model_, state);
    StateSaver saver(state);
    memory_.archive(saver);
    state.history_rows = memory_.history_rows;
    state.field_outputs = memory_.field_outputs;
    return state;
  }

  void take_up(const RunState& state) {
    restore_model_state(model_, state);
    StateRestorer restorer(state);
    memory_.archive(restorer);
    memory_.control.move_end();
    instant_.elapsed = memory_.elapsed;
  }

  void inputs_changed() {
    recording_.forget();
    sampled_forces_.forget();
  }

  /// Whether what comes next would wait for the device, or has enough before it: so many graphs that there is none too
  /// few while the host is with another member.
  bool busy() const {
    if (asked_) return (sample_ && answered_.ahead() > 0) || memory_.monitor.waits();
    const bool would_wait = memory_.control.would_wait() || recording_.would_wait() || sampled_forces_.would_wait();
    return recording_.graphs_ahead() > (would_wait ? 0 : most_graphs_ahead);
  }

  /// Whether what comes next may search for a step, which takes as long as hundreds of steps.
  bool may_search() const { return !asked_ && memory_.control.may_search(); }

  bool has_ended() const { return ended_; }
  double seconds_since_end() const { return since_end_.seconds(); }

  double next_history() const { return memory_.control.time_of(memory_.due.next_history()); }

  /// Of a run that has ended.
  RunSummary summary() {
    recording_.finish();
    const std::string trouble = keeping_.checkpoints ? keeping_.checkpoints->trouble() : std::string();
    if (!trouble.empty()) summary_.warnings.push_back(trouble);
    // Until all is written, but of a run beside others, whose ends it waited for.
    summary_.wall_seconds = since_first_step_.seconds() - (order_.own() ? since_end_.seconds() : 0);
    timing_.finish(summary_.wall_seconds - summary_.checkpoint_seconds, model_.step - summary_.first_step);
    summary_.monitor_seconds = timing_.monitor();
    summary_.output_seconds = timing_.outputs();
    summary_.completed = summary_.reason.empty();
    summary_.left_out = model_.left_out;
    if (leader_) summary_.ranks = leader_->summary();
    summary_.memory = leader_ ? leader_->peak_memories() : std::vector<double>{peak_memory()};
    summarize_steps(model_, model_, model_, model_.beams, memory_.control, summary_);
    summarize_findings(model_, as_made_, model_.contacts, memory_.monitor, memory_.swings, doubts_, summary_);
    for (RunObserver* observer : observers_) observer->end(model_, summary_);
    return summary_;
  }

 private:
  /// Of sixteen members they take the device 10 to 15 ms, as long as the host may be with one.
  static constexpr long most_graphs_ahead = 3;

  bool out_of_time() const { return keeping_.time_left > 0 && since_call_.seconds() >= keeping_.time_left; }
  bool may_go_on() const { return !stop_is_requested() && !out_of_time(); }

  std::vector<std::string> report_beginning() {
    for (RunObserver* observer : observers_) observer->begin(model_);
    std::vector<std::string> doubts = scene_doubts(model_, model_.contacts, model_.absorbing, model_.step_size);
    for (RunObserver* observer : observers_) observer->doubts(doubts);
    return doubts;
  }

  /// The time comes first: a checkpoint holds that of its step.
  void begin_step() {
    instant_.time = model_.time = memory_.control.time();
    stopping_ = false;
    if (!model_.subcycling.in_phase(model_.step)) return;
    summary_.out_of_time = out_of_time();
    stopping_ = summary_.out_of_time || stop_is_requested();
  }

  void checkpoint_if_due() {
    // A scene that was stopped while it settled has nothing to go on from.
    if (!keeping_.checkpoints || !model_.subcycling.in_phase(model_.step) || !prepared_) return;
    if (model_.step <= summary_.first_step) return;
    const bool interval_is_over = keeping_.interval > 0 && since_checkpoint_.seconds() >= keeping_.interval;
    if (memory_.due.last() ? keeping_.at_end : stopping_ || interval_is_over) checkpoint();
  }

  /// With patience, before anything that waits for the device: for one that does not answer that has no end.
  void wait_for_other_ranks() const {
    if (leader_) leader_->exchange().wait_for_rows();
  }

  void checkpoint() {
    wait_for_other_ranks();
    recording_.finish();
    const WallClock clock;
    keeping_.checkpoints->keep(state());
    ++summary_.checkpoints;
    since_checkpoint_.restart();
    summary_.checkpoint_seconds += clock.seconds();
  }

  /// The size of this step, and whether its instant is sampled.
  void plan_step() {
    const double size_before = model_.step_size;
    if (memory_.control.looks_at_model()) recording_.finish();
    memory_.control.check_elements();
    if (leader_ && memory_.control.due()) leader_->gather();
    if (memory_.control.renew()) memory_.due.step_changed(size_before);
    instant_.step = model_.step_size;
    // A run that goes on with a model that has run before begins at a later step.
    first_ = !keeping_.from && model_.step == summary_.first_step;
    fields_due_ = memory_.due.fields();
    output_due_ = memory_.due.history() || fields_due_.any() || stopping_ || summary_.fault;
    const bool monitor_due = memory_.monitor.due(model_.step) && model_.subcycling.in_phase(model_.step);
    sampled_ = output_due_ || first_ || monitor_due;
    const bool plain = !stopping_ && !summary_.fault && !first_;
    only_fields_ = plain && !monitor_due && fields_due_.any() && !memory_.due.history();
    const bool asked = sampled_ || memory_.monitor.contact_ends_due(model_.step);
    late_ = asked && plain && answers_may_be_late_ && !memory_.due.last() && !fields_due_.any();
    if (!sampled_ || order_.own()) return;
    if (late_) return late_sample_.announce();
    wait_for_other_ranks();
    recording_.finish();
    timing().begin();
  }

  WorkTiming& timing() { return output_due_ ? timing_.output_steps : timing_.monitor_steps; }

  bool samples_energies() const { return sampled_ && !only_fields_; }

  Instant in_order() const {
    Instant instant = instant_;
    instant.own_space = order_.own_space();
    return instant;
  }

  SampleUnderWay::What sample_wanted(bool energies_summed) {
    return {output_due_, energies_summed, memory_.monitor.part_energies(model_.step)};
  }

  /// Of this instant, what finish_late() needs.
  void ask_late(bool energies_summed) {
    late_of_ = model_.step;
    memory_.monitor.ask(order_.space(), samples_energies());
    if (sampled_) late_sample_.begin(model_, model_.step_size, sample_wanted(energies_summed));
  }

  /// Of this instant, what finish_step() needs.
  void ask(bool energies_summed) {
    memory_.monitor.ask(order_.space(), samples_energies());
    if (samples_energies()) {
      sample_ =
          std::make_unique<SampleUnderWay>(model_, model_.step_size, sample_wanted(energies_summed), order_.space());
      sample_->send(answered_);
    }
    asked_ = true;
  }

  /// From its forces on. @return false: the run has ended
  bool finish_step() {
    asked_ = false;
    if (order_.own() && sampled_) {
      order_.leave();
      timing().begin();
    }
    std::optional<HistorySample> answer;
    if (sample_) answer = sample_->finish(answered_);  // what a check asks besides would take its place
    sample_.reset();
    if (!late_) memory_.monitor.check_contact_ends(model_.step);
    if (sampled_ && !late_) monitor_and_output(std::move(answer));
    if (ends()) {
      ended_ = true;
      since_end_.restart();
      return false;
    }
    if (leader_) leader_->move(instant_);
    order_.enter();
    plans_.advance(in_order());
    if (sampled_ && late_) late_sample_.send();
    end_step();
    return true;
  }

  /// Whether nothing but the plan of advancing steps is due at a step to come.
  bool quiet(long step) const {
    return !memory_.due.any(step) && !memory_.monitor.due(step) && !memory_.monitor.contact_ends_due(step) &&
           !memory_.control.may_renew(step);
  }

  /// How many steps from this one on, which is not sampled, nobody looks at. Checks of contacts' ends come between
  /// forces and motion of a step.
  long quiet_steps(long most) const {
    if (memory_.monitor.contact_ends_due(model_.step)) return 0;
    long steps = 0;
    while (steps < most && (steps == 0 || quiet(model_.step + steps))) ++steps;
    return steps;
  }

  /// As many steps at once as a graph has.
  bool take_recorded_steps() {
    if (sampled_) return false;
    long steps = recording_.most();
    if (late_of_ >= 0) steps = std::min(steps, Monitor::steps_when_odd - model_.step % Monitor::steps_when_odd);
    steps = record_steps(quiet_steps(steps));
    if (steps == 0) return false;
    plans_.advance_clock(instant_, steps);
    end_step();
    finish_late();
    return true;
  }

  /// Takes what was asked late, before any step at which something is due: what it shows may make more of it due.
  /// Should it show that the run must stop, then it stops at the next step.
  void finish_late() {
    if (late_of_ < 0) return;
    const long step = std::exchange(late_of_, -1);
    if (!late_sample_.under_way()) return memory_.monitor.check_contact_ends(step);
    const bool is_history = late_sample_.is_history();
    HistorySample sample = late_sample_.finish(is_history ? timing_.output_steps : timing_.monitor_steps);
    memory_.monitor.check_contact_ends(step);
    watch(sample);
    for (RunObserver* observer : observers_) {
      if (is_history) observer->history(model_, sample);
      observer->progress(model_, sample);
    }
    if (is_history) ++memory_.history_rows;
  }

  bool asks_for_places() const { return memory_.monitor.asks_for_places(model_.step); }

  /// As many steps as other ranks can take without another order.
  bool take_shared_steps() {
    if (sampled_ || asks_for_places()) return false;
    constexpr long most = 64;
    const long steps = std::max(1L, quiet_steps(most)), end = model_.step + steps;
    leader_->advance(instant_, steps);
    while (model_.step < end) {
      instant_.time = model_.time = memory_.control.time();
      const bool check = memory_.monitor.contact_ends_due(model_.step);
      if (const long recorded = check ? 0 : record_steps(end - model_.step); recorded > 0) {
        plans_.advance_clock(instant_, recorded);
      } else {
        plans_.compute_forces(instant_, StepKind::advancing);
        if (check) wait_for_other_ranks();
        memory_.monitor.check_contact_ends(model_.step);
        plans_.advance(instant_);
      }
      end_step();
    }
    return true;
  }

  /// @return how many of the next steps were taken as one graph
  long record_steps(long quiet) {
    return recording_.advance(instant_, quiet, [this](long step) { return memory_.control.time_of(step); });
  }

  /// As a graph, with the sums of energies. Nodes in single precision must be brought into double before these.
  bool record_sampled_forces() {
    if (model_.relative.active()) return false;
    const auto time = [this](long step) { return memory_.control.time_of(step); };
    if (sampled_forces_.advance(instant_, 1, time) == 0) return false;
    plans_.forces_computed(StepKind::sampled);
    return true;
  }

  /// @param answer to what was asked; none: nothing was
  void monitor_and_output(std::optional<HistorySample> answer) {
    if (leader_ && fields_due_.any()) leader_->gather_fields();
    if (only_fields_) {  // energies and sums of forces are nobody's then, and take longer than the fields
      HistorySample sample;
      sample.time = model_.time;
      sample.step = model_.step;
      for (RunObserver* observer : observers_) observer->fields(model_, sample, fields_due_);
      ++memory_.field_outputs;
      return;
    }
    if (!answer)
      answer = (output_due_ ? take_sample : sample_for_monitor)(
          model_, model_.step_size, memory_.monitor.part_energies(model_.step), leader_.get());
    HistorySample& sample = *answer;
    if (first_) memory_.total_at_start = balance_total(sample.energy);
    if (output_due_) timing_.monitor_at_outputs.begin();
    watch(sample);
    if (output_due_) timing_.monitor_at_outputs.end();
    if (summary_.fault && !output_due_) add_history_values(model_, model_.step_size, sample, leader_.get());
    output(sample);
  }

  /// Looks for faults and reports them.
  void watch(HistorySample& sample) {
    sample.energy.balance_error = balance_total(sample.energy) - memory_.total_at_start;
    for (std::size_t c = 0; c < memory_.swings.size(); ++c)
      memory_.swings[c].add(sample.time, sample.contacts[c].normal_force);
    const std::vector<Fault> found = memory_.monitor.check(sample);
    if (leader_ && !found.empty()) leader_->gather();
    for (const Fault& fault : found)
      for (RunObserver* observer : observers_) observer->warning(model_, fault);
    const Fault* fault = memory_.monitor.fatal();
    if (!fault) return;
    summary_.fault = *fault;
    summary_.reason = fault->summary();
  }

  void output(const HistorySample& sample) {
    const bool last_chance = stopping_ || summary_.fault;
    if (leader_ && last_chance) leader_->gather();
    for (RunObserver* observer : observers_) {
      if (memory_.due.history() || last_chance) observer->history(model_, sample);
      if (fields_due_.any())
        observer->fields(model_, sample, fields_due_);
      else if (last_chance)
        observer->fields(model_, sample, {true, {}});
      observer->progress(model_, sample);
    }
    if (memory_.due.history()) ++memory_.history_rows;
    if (fields_due_.any()) ++memory_.field_outputs;
  }

  bool ends() {
    if (summary_.fault || memory_.due.last()) return true;
    if (!stopping_) return false;
    summary_.reason = prepared_ ? fmt::format("{} at step {} of {}, t = {:.6g} s",
                                              summary_.out_of_time ? "the wall time is spent" : "interrupted",
                                              model_.step, model_.step_count, model_.time)
                                : while_settling(model_.scene, summary_.out_of_time);
    return true;
  }

  void end_step() {
    instant_.elapsed = memory_.elapsed = model_.step_size;
    if (sampled_ && !late_) timing().end();
  }

  LaunchOrder order_;
  const WallClock since_call_;
  WallClock since_checkpoint_, since_first_step_, since_end_;
  Model& model_;
  const std::vector<RunObserver*>& observers_;
  const RunKeeping& keeping_;
  const std::vector<std::string> doubts_;
  const bool in_equilibrium_;
  const bool prepared_;  ///< false: stopped while it settled
  const SceneAsMade as_made_;
  std::unique_ptr<RankLeader> leader_;  ///< of other ranks; null: there are none
  LoopMemory memory_;
  StepPlans plans_;
  StepRecording recording_;
  StepRecording sampled_forces_;  ///< with the sums of energies
  const bool answers_may_be_late_;
  LateSample late_sample_;
  long late_of_ = -1;  ///< the step of what was asked late, and is to be taken; -1: nothing
  Milestone answered_;
  std::unique_ptr<SampleUnderWay> sample_;  ///< that was asked for
  bool asked_ = false;                      ///< and the step is to be finished
  RunSummary summary_;
  SampleTiming timing_;
  Instant instant_;
  bool begun_ = false, ended_ = false;
  bool first_ = false;     ///< of all steps of the run, not of one that goes on from a checkpoint
  bool stopping_ = false;  ///< after this step
  DueFields fields_due_;
  bool output_due_ = false;   ///< histories or fields
  bool only_fields_ = false;  ///< and nothing else of a sampled instant
  bool sampled_ = false;      ///< the instant's forces and energies are sampled
  bool late_ = false;         ///< what this step asks, if only for contacts' ends, may come late
};

}  // namespace railwave
