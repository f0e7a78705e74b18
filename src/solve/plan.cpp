#include "solve/plan.hpp"

#include <fmt/format.h>

#include <iterator>

#include "solve/tasks.hpp"

namespace railwave {

void run_tasks(const std::vector<Task>& tasks, const Instant& instant, long step_number) {
  for (const Task& task : tasks) {
    if (!task.due(step_number)) continue;
    Kokkos::Profiling::pushRegion(task.name);
    task.run(instant);
    Kokkos::Profiling::popRegion();
  }
}

std::vector<std::string> describe_plan(const Plan& plan) {
  std::vector<std::string> lines;
  for (const std::vector<Task>* tasks : {&plan.forces, &plan.motion})
    for (const Task& task : *tasks) {
      lines.push_back(fmt::format("({}) {}", task.step, task.name));
      if (task.every > 1) lines.back() += fmt::format(" [every {} steps]", task.every);
    }
  return lines;
}

void append(std::vector<Task>& tasks, std::vector<Task> more) {
  tasks.insert(tasks.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<Task> own_force_tasks(Model& model, StepKind kind) {
  std::vector<Task> tasks = load_tasks(model, kind);
  append(tasks, contact_tasks(model, kind));
  append(tasks, element_tasks(model, kind));
  return tasks;
}

std::vector<Task> force_tasks(Model& model, StepKind kind, const RelaxationUpdate* relaxation) {
  std::vector<Task> tasks = own_force_tasks(model, kind);
  append(tasks, tie_tasks(model));
  append(tasks, non_reflecting_tasks(model, kind));
  append(tasks, multiplier_tasks(model, kind, relaxation));
  return tasks;
}

Plan make_plan(Model& model, StepKind kind) { return {force_tasks(model, kind), motion_tasks(model, kind)}; }

StepPlans::StepPlans(Model& model)
    : model_(model), advancing_(make_plan(model, StepKind::advancing)), sampled_(make_plan(model, StepKind::sampled)) {}

void StepPlans::compute_forces(const Instant& instant, StepKind kind) {
  kind_ = kind;
  run_tasks(of(kind).forces, instant, model_.step);
}

void StepPlans::advance(const Instant& instant) {
  run_tasks(of(kind_).motion, instant, model_.step);
  advance_clock(instant);
}

void StepPlans::advance_clock(const Instant& instant) {
  ++model_.step;
  model_.velocity_lag = 0.5 * instant.step;
}

}  // namespace railwave
