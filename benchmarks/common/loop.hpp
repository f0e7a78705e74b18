#pragma once

#include <string>
#include <utility>
#include <vector>

#include "benchmarks/common/timing.hpp"
#include "solve/plan.hpp"

namespace railwave::bench {

/// The time loop of a model without anything between the steps: no output, no account, no check.
class Loop {
 public:
  explicit Loop(Model& model) : model_(model), plans_(model) { instant_.step = model.step_size; }

  void steps(long count) {
    for (long k = 0; k < count; ++k) step();
  }

  void step() {
    compute_forces(StepKind::advancing);
    finish();
  }

  /// A step that is sampled when the forces are known.
  template <class Observe>
  void sampled_step(const Observe& observe) {
    forces();
    observe();
    finish();
  }

  /// Forces at the present instant, for fields that need them.
  void forces() { compute_forces(StepKind::sampled); }

  /// Seconds a step of each task by name, the nodes' motion last, over `count` steps with a fence after every task.
  /// Their sum is more than a step of the loop, which has no fences.
  std::vector<std::pair<std::string, double>> task_seconds(long count) {
    const std::vector<Task>& tasks = plans_.of(StepKind::advancing).forces;
    std::vector<std::pair<std::string, double>> result;
    for (const Task& task : tasks) result.emplace_back(task.name, 0.0);
    result.emplace_back("nodes", 0.0);
    for (long k = 0; k < count; ++k) {
      set_time();
      for (std::size_t s = 0; s < tasks.size(); ++s)
        result[s].second += seconds_of([&] {
          if (tasks[s].due(model_.step)) tasks[s].run(instant_);
        });
      result.back().second +=
          seconds_of([&] { run_tasks(plans_.of(StepKind::advancing).motion, instant_, model_.step); });
      plans_.advance_clock(instant_);
      instant_.elapsed = model_.step_size;
    }
    for (auto& entry : result) entry.second /= static_cast<double>(count);
    return result;
  }

 private:
  void set_time() { instant_.time = model_.time = static_cast<double>(model_.step) * model_.step_size; }

  void compute_forces(StepKind kind) {
    set_time();
    plans_.compute_forces(instant_, kind);
  }

  void finish() {
    plans_.advance(instant_);
    instant_.elapsed = model_.step_size;
  }

  Model& model_;
  StepPlans plans_;
  Instant instant_;
};

}  // namespace railwave::bench
