#include "solve/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "solve/ranks/row_exchange.hpp"
#include "solve/tasks/contributions.hpp"

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

std::vector<Task> placed(std::vector<Task> tasks, Stage stage, int lane) {
  for (Task& task : tasks) {
    task.stage = stage;
    task.lane = lane;
  }
  return tasks;
}

void append(std::vector<Task>& tasks, std::vector<Task> more) {
  tasks.insert(tasks.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

namespace {

GoingAlong going_along(const Model& model, StepKind kind, const RowExchange* exchange) {
  GoingAlong along;
  if (exchange != nullptr) return along;  // the first launch is of a few blocks only, which others wait for
  along.contact = contact_goes_along(model.elements, model.contacts, kind);
  // Ties, non-reflecting ends and prescribed motions must find the loads where they add to them.
  const bool added_to = model.ties.arrays.active() || model.ends.arrays.count > 0 || !model.prescribed.empty();
  along.sets = along.contact && sets_go_along(model, model.sets) && !added_to;
  return along;
}

EarlyNodes early_nodes(const Model& model, const RowExchange* exchange) {
  if (exchange != nullptr) return exchange->between_devices() ? EarlyNodes::apart : EarlyNodes::with_others;
  return model.ties.arrays.active() || model.parts.group >= 0 ? EarlyNodes::apart : EarlyNodes::beside_motion;
}

std::vector<Task> motion_tasks(Model& model, StepKind kind, const RowExchange* exchange) {
  std::vector<Task> tasks = prescribed_tasks(model, model.prescribed);
  if (model.beams && kind != StepKind::advancing)
    append(tasks, placed({rotation_task(model, *model.beams)}, Stage::motion, MotionLanes::rotations));
  append(tasks, node_tasks(model, model.elements, model, kind, going_along(model, kind, exchange),
                           early_nodes(model, exchange)));
  if (model.ties.arrays.active())
    append(tasks, placed({tied_nodes_task(model, model.ties, kind)}, Stage::tied_motion, 0));
  return tasks;
}

}  // namespace

namespace {

/// Whether outer blocks need nothing that the same step launches in the default order.
bool outer_blocks_may_go_beside(const ElementModel& elements) {
  return std::none_of(elements.elements.begin(), elements.elements.end(), [](const ElementGroup& group) {
    return group.damping.active() || group.blocks.frame.extent(0) > 0;
  });
}

/// To come before the search of pairs with springs, or of those without: where it checks a window the host waits for
/// the device, which would wait without end for the rows of a rank that does not answer.
std::vector<Task> wait_before_search(const Model& model, bool springs, const RowExchange* exchange) {
  const auto& contacts = model.contacts;
  const auto searched = [springs](const ContactPair& pair) { return pair.has_springs() == springs; };
  if (exchange == nullptr || std::none_of(contacts.begin(), contacts.end(), searched)) return {};
  const NodalState& nodal = model;
  Task task{"rows of other ranks, before a contact's window is checked", "d",
            [&nodal, &contacts, searched, exchange](const Instant&) {
              for (const ContactPair& pair : contacts)
                if (searched(pair) && nodal.step >= pair.next_check) return exchange->wait_for_rows();
            }};
  task.recordable = false;
  return {task};
}

/// @param space null: the tasks stay in the default one
std::vector<Task> in_space(std::vector<Task> tasks, const ExecutionSpace* space) {
  if (space == nullptr) return tasks;
  for (Task& task : tasks)
    task.run = [run = std::move(task.run), space](const Instant& instant) {
      Instant here = instant;
      here.own_space = space;
      run(here);
    };
  return tasks;
}

/// Between ranks' devices: what comes after all elements goes beside the nodes that no other task waits for.
void put_others_beside(Plan& plan, RowExchange& exchange) {
  const auto later = std::find_if(plan.forces.begin(), plan.forces.end(),
                                  [](const Task& task) { return task.stage > Stage::own_forces; });
  const auto beside = [&](const Task& task) {
    return task.apart() ? task : in_space({task}, exchange.side_space()).front();
  };
  std::transform(later, plan.forces.end(), later, beside);
  std::transform(plan.motion.begin(), plan.motion.end(), plan.motion.begin(), beside);
  plan.forces.insert(later, placed({exchange.side_begin_task()}, Stage::passed_on, 0).front());
  append(plan.motion, placed({exchange.side_end_task()}, Stage::tied_motion, 0));
}

}  // namespace

std::vector<Task> shared_force_tasks(Model& model, StepKind kind, RowExchange& exchange, std::vector<Task> others) {
  const RankShare& share = exchange.share();
  const bool beside = exchange.between_devices() && outer_blocks_may_go_beside(model);
  std::vector<Task> tasks = exchange.begin_tasks();
  // In the default order they would keep the inner blocks waiting until the outer ones are done. They are small and
  // long in line: the outer blocks leave them room where these come second.
  append(tasks, in_space(std::move(others), beside ? exchange.side_space() : nullptr));
  append(tasks, in_space(element_tasks(model, model, model.contacts, model, kind, {}, {&share.outer, true}),
                         beside ? exchange.outer_space() : nullptr));
  tasks.push_back(exchange.send_task(beside));
  append(tasks, element_tasks(model, model, model.contacts, model, kind, {}, {&share.inner, false}));
  tasks.push_back(exchange.receive_task());
  return tasks;
}

std::vector<Task> own_force_tasks(Model& model, StepKind kind, RowExchange* exchange) {
  const GoingAlong along = going_along(model, kind, exchange);
  std::vector<Task> tasks;
  if (model.relative.active() && kind != StepKind::settling)
    tasks.push_back(corotating_frames_task(model, model.elements, model, kind));
  append(tasks, frame_tasks(model, model, kind));
  constexpr int of_contact = OwnForceLanes::contact;
  std::vector<Task> others = load_tasks(model, model, model.beams, kind, along);
  append(others, placed(wait_before_search(model, true, exchange), Stage::own_forces, of_contact));
  append(others, placed(contact_tasks(model.scene, model, model.contacts, kind, along), Stage::own_forces, of_contact));
  if (exchange != nullptr) {
    append(tasks, shared_force_tasks(model, kind, *exchange, std::move(others)));
    return tasks;
  }
  append(tasks, std::move(others));
  append(tasks, element_tasks(model, model, model.contacts, model, kind, along));
  return tasks;
}

std::vector<Task> force_tasks(Model& model, StepKind kind, const RelaxationUpdate* relaxation, RowExchange* exchange) {
  std::vector<Task> tasks = own_force_tasks(model, kind, exchange);
  const MultiplierTasks multipliers = multiplier_tasks(model.scene, model, model.contacts, kind, relaxation);
  append(tasks, placed(wait_before_search(model, false, exchange), Stage::own_forces, OwnForceLanes::contact));
  append(tasks, placed(multipliers.locate, Stage::own_forces, OwnForceLanes::contact));
  append(tasks, tie_tasks(model, model.ties));
  append(tasks, placed(non_reflecting_tasks(model, model.ends, kind),
                       model.ties.at_ends ? Stage::last_forces : Stage::passed_on, 1));
  append(tasks, placed(multipliers.find, Stage::motion, MotionLanes::contact));
  return tasks;
}

Plan make_plan(Model& model, StepKind kind, RowExchange* exchange) {
  Plan plan{force_tasks(model, kind, nullptr, exchange), motion_tasks(model, kind, exchange)};
  const auto is_apart = [](const Task& task) { return task.begins == Begins::after_own_forces; };
  if (exchange != nullptr && std::any_of(plan.motion.begin(), plan.motion.end(), is_apart))
    put_others_beside(plan, *exchange);
  return plan;
}

StepPlans::StepPlans(Model& model, RowExchange* exchange)
    : StepPlans(model, make_plan(model, StepKind::advancing, exchange), make_plan(model, StepKind::sampled, exchange)) {
}

StepPlans::StepPlans(NodalState& nodal, Plan advancing, Plan sampled)
    : nodal_(nodal), advancing_(std::move(advancing)), sampled_(std::move(sampled)) {}

void StepPlans::compute_forces(const Instant& instant, StepKind kind) {
  kind_ = kind;
  run_tasks(of(kind).forces, instant, nodal_.step);
}

void StepPlans::advance(const Instant& instant) {
  run_tasks(of(kind_).motion, instant, nodal_.step);
  advance_clock(instant);
}

void StepPlans::advance_clock(const Instant& instant, long steps) {
  nodal_.step += steps;
  nodal_.velocity_lag = 0.5 * instant.step;
}

}  // namespace railwave
