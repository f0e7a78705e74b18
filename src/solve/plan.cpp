#include "solve/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "model/beams/beams.hpp"
#include "model/host_copy.hpp"
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

/// What moves before other nodes.
std::vector<Task> motions_of_others(Model& model, StepKind kind) {
  std::vector<Task> tasks = prescribed_tasks(model, model.prescribed);
  if (model.beams && kind != StepKind::advancing)
    append(tasks, placed({rotation_task(model, *model.beams)}, Stage::motion, MotionLanes::rotations));
  return tasks;
}

std::vector<Task> tied_motion(Model& model, StepKind kind) {
  if (!model.ties.arrays.active()) return {};
  return placed({tied_nodes_task(model, model.ties, kind)}, Stage::tied_motion, 0);
}

std::vector<Task> motion_tasks(Model& model, StepKind kind) {
  const bool apart = model.ties.arrays.active() || model.parts.group >= 0;
  std::vector<Task> tasks = motions_of_others(model, kind);
  append(tasks, node_tasks(model, model.elements, model, kind, going_along(model, kind, nullptr),
                           apart ? EarlyNodes::apart : EarlyNodes::beside_motion));
  append(tasks, tied_motion(model, kind));
  return tasks;
}

/// Whether outer blocks need nothing that the same step launches in the default order.
bool outer_blocks_may_go_beside(const ElementModel& elements) {
  return std::none_of(elements.elements.begin(), elements.elements.end(), [](const ElementGroup& group) {
    return group.damping.active() || group.blocks.frame.extent(0) > 0;
  });
}

/// To come before the search of contact: where it checks a window the host waits for the device, which would wait
/// without end for the rows of a rank that does not answer.
std::vector<Task> wait_before_search(const Model& model, const RowExchange& exchange) {
  if (model.contacts.empty()) return {};
  Task task{"rows of other ranks, before a contact's window is checked", "d", [&model, &exchange](const Instant&) {
              const auto is_due = [&model](const ContactPair& pair) { return model.step >= pair.next_check; };
              if (std::any_of(model.contacts.begin(), model.contacts.end(), is_due)) exchange.wait_for_rows();
            }};
  task.recordable = false;
  return placed({task}, Stage::own_forces, OwnForceLanes::contact);
}

/// Whether a rank's lanes go on side by side up to the end of a step: nodes of this rank alone wait for no message,
/// nodes of several ranks for no inner block, and what late nodes wait for comes after their blocks, which are the
/// rank's own.
bool in_lanes(const Model& model, StepKind kind, const RowExchange& exchange) {
  const bool any_late = model.first_late < static_cast<int>(model.shared.nodes.extent(0));
  return kind == StepKind::advancing && exchange.between_devices() && outer_blocks_may_go_beside(model) &&
         model.subcycling.levels == 1 && (!any_late || exchange.share().has_late_blocks());
}

/// Nodes that ties, multipliers, prescribed motions or ends move, and tied ones.
class LateNodes {
 public:
  explicit LateNodes(const Model& model) : late_(model.nodes.count, 0) {
    const auto shared = to_host(model.shared.nodes);
    for (std::size_t i = model.first_late; i < shared.extent(0); ++i) late_[shared(i).node & ~special_bit] = 1;
    for (const TiedPlace& tied : model.ties.places) late_[tied.slave] = 1;
  }

  bool any_of(const std::vector<int>& nodes) const {
    return std::any_of(nodes.begin(), nodes.end(), [this](int n) { return late_[n] != 0; });
  }
  bool any_of(const Array<LoadedRow*>& rows) const {
    const std::vector<LoadedRow> list = to_vector(rows);
    return std::any_of(list.begin(), list.end(), [this](const LoadedRow& row) { return late_[row.node] != 0; });
  }

 private:
  std::vector<char> late_;
};

/// Whether loads, sets of nodes that move as one, or beams concern late nodes.
bool loads_concern_late_nodes(const Model& model) {
  const LateNodes late(model);
  return late.any_of(to_vector(model.external.contribution_node)) || late.any_of(nodes_of_moving_sets(model)) ||
         late.any_of(model.set_teams.rows) || (model.beams && late.any_of(to_vector(model.beams->arrays.node)));
}

/// What lanes wait for as a step begins.
std::vector<LaneWait> waits_at_begin(const Model& model, StepKind kind, const RowExchange& exchange) {
  return in_lanes(model, kind, exchange) ? others_wait_in_lanes(loads_concern_late_nodes(model)) : others_wait();
}

/// Loads and beams in their lanes. What needs both is with beams, so that what moves late nodes does not wait for it;
/// where it concerns these it is with loads, and waits for the motion before, which took the loads of that step.
std::vector<Task> loads_in_lanes(const Model& model, std::vector<Task> loads, const RowExchange& exchange) {
  using Lane = RankLane;
  const Lane of_both = LateNodes(model).any_of(model.set_teams.others) ? Lane::loads : Lane::beams;
  std::vector<Task> tasks;
  for (Task& task : loads) {
    Lane lane = task.lane == OwnForceLanes::beams ? Lane::beams : Lane::loads;
    if (task.joins == OwnForceLanes::beams) {
      lane = of_both;
      tasks.push_back(exchange.wait_task(
          lane == Lane::beams ? std::vector<LaneWait>{{Lane::beams, Lane::loads}}
                              : std::vector<LaneWait>{{Lane::loads, Lane::beams}, {Lane::loads, Lane::motion}}));
    }
    append(tasks, exchange.in_lane(lane, {std::move(task)}));
  }
  return tasks;
}

/// What comes after own forces: ties and multipliers that need no loads in lanes of their own.
std::vector<Task> passed_on_in_lanes(std::vector<Task> forces, const RowExchange& exchange) {
  using Lane = RankLane;
  std::vector<Task> tasks;
  bool beside = false;
  const auto wait = [&] {
    if (beside) tasks.push_back(exchange.wait_task({{Lane::motion, Lane::late}, {Lane::motion, Lane::contact}}));
    beside = false;
  };
  for (Task& task : forces) {
    if (task.stage <= Stage::own_forces) {
      tasks.push_back(std::move(task));
      continue;
    }
    const bool unloaded = task.begins == Begins::beside_loads;
    const RankLane lane = !unloaded ? Lane::motion : task.stage == Stage::passed_on ? Lane::late : Lane::contact;
    if (!unloaded && task.stage > Stage::passed_on) wait();
    beside = beside || unloaded;
    append(tasks, exchange.in_lane(lane, {std::move(task)}));
  }
  wait();
  return tasks;
}

}  // namespace

std::vector<Task> shared_force_tasks(Model& model, StepKind kind, RowExchange& exchange, BesideElements beside) {
  using Lane = RankLane;
  const RankShare& share = exchange.share();
  const auto elements = [&](const std::vector<Array<int*>>& blocks, bool first) {
    return element_tasks(model, model, model.contacts, model, kind, {}, {&blocks, first});
  };
  const bool any_late = share.has_late_blocks();
  std::vector<Task> late, outer = elements(share.outer, !any_late), inner = elements(share.inner, false);
  if (any_late) late = elements(share.late, true);
  std::vector<Task> tasks = exchange.begin_tasks(waits_at_begin(model, kind, exchange));
  if (!exchange.between_devices() || !outer_blocks_may_go_beside(model)) {
    for (std::vector<Task>* next : {&beside.loads, &beside.contact, &late, &outer}) append(tasks, std::move(*next));
    tasks.push_back(exchange.send_task(false));
    append(tasks, std::move(inner));
    tasks.push_back(exchange.receive_task());
    return tasks;
  }
  // Loads and contact are small and long in line: blocks leave them room where these come second.
  append(tasks, exchange.in_lane(Lane::contact, std::move(beside.contact)));
  if (exchange.pushes_others()) tasks.push_back(exchange.wait_task({{Lane::messages, Lane::contact}}));
  append(tasks, loads_in_lanes(model, std::move(beside.loads), exchange));
  append(tasks, exchange.in_lane(Lane::late, std::move(late)));
  append(tasks, exchange.in_lane(Lane::outer, std::move(outer)));
  append(tasks, std::move(inner));
  tasks.push_back(exchange.send_task(true));
  if (!in_lanes(model, kind, exchange)) {
    tasks.push_back(exchange.receive_task());
    return tasks;
  }
  // Before what moves nodes of this rank alone, ties and late nodes. On nodes of several ranks only elements act, and
  // contact that is waited for above.
  tasks.push_back(exchange.wait_task({{Lane::inner, Lane::outer},
                                      {Lane::inner, Lane::late},
                                      {Lane::inner, Lane::contact},
                                      {Lane::motion, Lane::loads},
                                      {Lane::motion, Lane::late},
                                      {Lane::motion, Lane::contact},
                                      {Lane::late, Lane::contact},
                                      {Lane::contact, Lane::late}}));
  return tasks;
}

std::vector<Task> rank_motion_tasks(Model& model, StepKind kind, RowExchange& exchange, BesideNodes beside) {
  std::vector<Task> tasks = std::move(beside.before);
  if (!in_lanes(model, kind, exchange)) {
    append(tasks, node_tasks(model, model.elements, model, kind, {}, EarlyNodes::with_others));
    append(tasks, std::move(beside.after));
    return tasks;
  }
  RankNodeTasks nodes = rank_node_tasks(model, model);
  append(tasks, std::move(nodes.late));
  append(tasks, std::move(beside.after));
  tasks = exchange.in_lane(RankLane::motion, std::move(tasks));
  append(tasks, std::move(nodes.own_plain));
  tasks.push_back(exchange.wait_task({{RankLane::inner, RankLane::loads}, {RankLane::inner, RankLane::beams}}));
  append(tasks, std::move(nodes.own));
  append(tasks, exchange.in_lane(RankLane::messages, std::move(nodes.between_ranks)));
  tasks.push_back(exchange.end_task());
  return tasks;
}

std::vector<Task> own_force_tasks(Model& model, StepKind kind, std::vector<Task> locate, RowExchange* exchange) {
  const GoingAlong along = going_along(model, kind, exchange);
  std::vector<Task> tasks;
  if (model.relative.active() && kind != StepKind::settling)
    tasks.push_back(corotating_frames_task(model, model.elements, model, kind));
  append(tasks, frame_tasks(model, model, kind));
  std::vector<Task> loads = load_tasks(model, model, model.beams, kind, along);
  std::vector<Task> springs =
      placed(contact_tasks(model.scene, model, model.contacts, kind, along), Stage::own_forces, OwnForceLanes::contact);
  locate = placed(std::move(locate), Stage::own_forces, OwnForceLanes::contact);
  if (exchange != nullptr) {
    BesideElements beside{std::move(loads), wait_before_search(model, *exchange)};
    append(beside.contact, std::move(springs));
    append(beside.contact, std::move(locate));
    append(tasks, shared_force_tasks(model, kind, *exchange, std::move(beside)));
    return tasks;
  }
  append(tasks, std::move(loads));
  append(tasks, std::move(springs));
  append(tasks, element_tasks(model, model, model.contacts, model, kind, along));
  append(tasks, std::move(locate));
  return tasks;
}

std::vector<Task> force_tasks(Model& model, StepKind kind, const RelaxationUpdate* relaxation, RowExchange* exchange) {
  MultiplierTasks multipliers = multiplier_tasks(model.scene, model, model.contacts, kind, relaxation);
  std::vector<Task> tasks = own_force_tasks(model, kind, std::move(multipliers.locate), exchange);
  append(tasks, tie_tasks(model, model.ties));
  append(tasks, placed(non_reflecting_tasks(model, model.ends, kind),
                       model.ties.at_ends ? Stage::last_forces : Stage::passed_on, 1));
  append(tasks, placed(std::move(multipliers.find), Stage::motion, MotionLanes::contact));
  return tasks;
}

Plan make_plan(Model& model, StepKind kind, RowExchange* exchange) {
  Plan plan{force_tasks(model, kind, nullptr, exchange), {}};
  if (exchange == nullptr) {
    plan.motion = motion_tasks(model, kind);
    return plan;
  }
  if (in_lanes(model, kind, *exchange)) plan.forces = passed_on_in_lanes(std::move(plan.forces), *exchange);
  plan.motion = rank_motion_tasks(model, kind, *exchange, {motions_of_others(model, kind), tied_motion(model, kind)});
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
