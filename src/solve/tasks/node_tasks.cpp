#include <algorithm>
#include <utility>

#include "kernels/nodes/shared_nodes.hpp"
#include "model/boundaries/prescribed_nodes.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/relative_coordinates.hpp"
#include "solve/tasks/beam_forces.hpp"
#include "solve/tasks/contributions.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {

NodeAdvance node_advance(const NodalState& nodal, double step) {
  return {nodal.nodes, nodal.gravity, nodal.velocity_lag + 0.5 * step, step};
}

namespace {

/// With subcycling: the nodes whose own step begins now.
Task subcycled_task(const NodalState& nodal, bool shared_alone) {
  return {"nodes in phase", "f to j", [&nodal, shared_alone](const Instant& instant) {
            const int phase = nodal.subcycling.phase(nodal.step);
            SubcycledNodeUpdate update{nodal.subcycled_acceleration(), node_advance(nodal, instant.step), {}};
            update.acceleration.phase = phase;
            if (shared_alone) update.shared = nodal.shared.nodes;
            const int count = shared_alone ? nodal.subcycling.shared_end[phase] : nodal.nodes.count;
            if (count > 0) Kokkos::parallel_for("subcycled_nodes", Range(instant.space(), 0, count), update);
          }};
}

/// Nodes in single precision that belong to one block alone.
Task relative_blocks_task(const NodalState& nodal, const std::vector<ElementGroup>& groups) {
  return {"inner nodes of the elements' blocks", "f to j", [&nodal, &groups](const Instant& instant) {
            for (const ElementGroup& group : groups)
              launch_blocks(group.blocks, group.whole ? nullptr : &group.own_blocks,
                            RelativeBlockUpdate{group.blocks, relative_advance(nodal, group.relative, instant.step),
                                                nodal.partial.in_single, group.first_partial},
                            instant.space());
          }};
}

/// Of nodal.shared.
struct SharedRange {
  std::string name;
  int begin, end;
};

/// @param rows_are_due the loads that follow from sets are left to the nodes that feel them
SharedForces shared_forces(const NodalState& nodal, const LoadModel& loads, bool rows_are_due, const Instant& instant) {
  return {nodal.acceleration(), nodal.shared, row_loads(nodal, loads, instant.elapsed), rows_are_due};
}

/// Shared nodes from `range.begin` to `range.end`, with all that can concern them.
Task shared_task(const NodalState& nodal, const LoadModel& loads, bool rows_are_due, const SharedRange& range) {
  return {range.name, "f to j", [&nodal, &loads, rows_are_due, range](const Instant& instant) {
            const Range nodes(instant.space(), range.begin, range.end);
            const SharedForces forces = shared_forces(nodal, loads, rows_are_due, instant);
            if (nodal.relative.active())
              Kokkos::parallel_for(
                  "shared_nodes", nodes,
                  RelativeSharedUpdate{forces, relative_advance(nodal, {}, instant.step), nodal.relative.shared_arm});
            else
              Kokkos::parallel_for("shared_nodes", nodes, SharedNodeUpdate{forces, node_advance(nodal, instant.step)});
          }};
}

/// Those that nothing but elements concerns.
Task plain_shared_task(const NodalState& nodal, const SharedRange& range) {
  return {
      range.name, "f to j", [&nodal, range](const Instant& instant) {
        // Registers for ten blocks of a multiprocessor: what these threads do is wait for memory.
        using Waiting = Kokkos::RangePolicy<ExecutionSpace, Kokkos::LaunchBounds<128, 10>, AsArgument>;
        const Waiting nodes(instant.space(), range.begin, range.end);
        const NodalForce force = nodal.acceleration().force;
        if (nodal.relative.active())
          Kokkos::parallel_for("plain_nodes", nodes,
                               RelativePlainUpdate{force, nodal.shared.nodes, relative_advance(nodal, {}, instant.step),
                                                   nodal.relative.shared_arm});
        else if (nodal.partial.single_precision)
          Kokkos::parallel_for("plain_nodes", nodes,
                               PlainNodeUpdate<float>{force, nodal.shared.nodes, node_advance(nodal, instant.step)});
        else
          Kokkos::parallel_for("plain_nodes", nodes,
                               PlainNodeUpdate<double>{force, nodal.shared.nodes, node_advance(nodal, instant.step)});
      }};
}

/// Plain nodes of a range and others have lanes of their own, where plain ones have a launch of theirs.
std::vector<Task> placed_nodes(const NodalState& nodal, const LoadModel& loads, bool rows_are_due,
                               const SharedRange& range, Stage stage, int lane, Begins begins) {
  const int first_special = std::clamp(nodal.shared.first_special, range.begin, range.end);
  const bool plain_apart = first_special == range.end || nodal.plain_apart;
  const int others = plain_apart ? first_special : range.begin;
  std::vector<Task> tasks;
  const auto add = [&](Task task, int lane_of_part) {
    task.bulk = stage == Stage::motion;
    task.begins = begins;
    append(tasks, placed({std::move(task)}, stage, lane_of_part));
  };
  if (others < range.end) add(shared_task(nodal, loads, rows_are_due, {range.name, others, range.end}), lane + 1);
  if (range.begin < others) add(plain_shared_task(nodal, {range.name + ", plain", range.begin, others}), lane);
  return tasks;
}

Task node_task(const NodalState& nodal) {
  return {"nodes", "f to j", [&nodal](const Instant& instant) {
            const int own = static_cast<int>(nodal.own_nodes.extent(0));
            Kokkos::parallel_for("node_update", Range(instant.space(), 0, own > 0 ? own : nodal.nodes.count),
                                 NodeUpdate{nodal.acceleration(), node_advance(nodal, instant.step), nodal.own_nodes});
          }};
}

Task prescribed_task(const NodalState& nodal, const PrescribedSet& set) {
  return {"prescribed motion of " + set.motion->target, "g", [&nodal, &set](const Instant& instant) {
            PrescribedMotion motion = prescribed_motion(nodal, set, instant.step);
            if (instant.places != nullptr) motion.next.recorded = instant.places + set.number;
            Kokkos::parallel_for("prescribed_motion", Range(instant.space(), 0, static_cast<int>(set.nodes.extent(0))),
                                 motion);
          }};
}

}  // namespace

Task corotating_frames_task(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, NodalState& nodal,
                            StepKind kind) {
  Task task{"co-rotating frames of nodes in single precision", "j",
            [&assembled, &groups, &nodal, kind](const Instant& instant) {
              if (!nodal.relative.begun) {
                begin_relative_nodes(assembled, groups, nodal);
                ExecutionSpace().fence();
              } else if (kind == StepKind::sampled) {
                update_absolute_nodes(nodal, instant.space());
              }
              compute_frame_steps(instant.space(), nodal, instant.step);
            }};
  task.recordable = false;
  return task;
}

Task tied_nodes_task(const NodalState& nodal, const Ties& ties, StepKind kind) {
  const bool relative = nodal.relative.active() && kind != StepKind::settling;
  return {"tied nodes", "g", [&nodal, &ties, relative](const Instant& instant) {
            const TieFollow follow{ties.arrays, nodal.nodes, instant.step};
            const SpreadRange slaves(instant.space(), 0, ties.arrays.slave_count);
            if (relative)
              Kokkos::parallel_for(
                  "ties", slaves,
                  RelativeTieFollow{follow, relative_advance(nodal, {}, instant.step).nodes, ties.frame});
            else
              Kokkos::parallel_for("ties", slaves, follow);
          }};
}

std::vector<Task> prescribed_tasks(const NodalState& nodal, const std::vector<PrescribedSet>& prescribed) {
  std::vector<Task> tasks;
  for (const PrescribedSet& set : prescribed) {
    const int lane = set.pushed ? MotionLanes::contact : MotionLanes::prescribed + set.first_alike;
    append(tasks, placed({prescribed_task(nodal, set)}, Stage::motion, lane));
    if (!set.loaded && !set.pushed) tasks.back().begins = Begins::beside_loads;
  }
  return tasks;
}

std::vector<Task> node_tasks(const NodalState& nodal, const std::vector<ElementGroup>& groups, const LoadModel& loads,
                             StepKind kind, GoingAlong along, EarlyNodes early_nodes) {
  const bool inner_have_moved = kind == StepKind::advancing;
  if (nodal.subcycling.levels > 1) return placed({subcycled_task(nodal, inner_have_moved)}, Stage::other_motion, 0);
  std::vector<Task> tasks;
  const bool relative = nodal.relative.active();
  if (!inner_have_moved && !relative) return placed({node_task(nodal)}, Stage::other_motion, 0);
  if (!inner_have_moved) append(tasks, placed({relative_blocks_task(nodal, groups)}, Stage::other_motion, 0));
  const bool divided = inner_have_moved && early_nodes != EarlyNodes::with_others;
  const int all = static_cast<int>(nodal.shared.nodes.extent(0)), early = divided ? nodal.early_shared : 0;
  const std::string name = "nodes that element blocks share";
  const auto add = [&](const SharedRange& range, Stage stage, int lane, Begins begins = Begins::in_order) {
    append(tasks, placed_nodes(nodal, loads, along.sets, range, stage, lane, begins));
  };
  if (divided && nodal.parts.group >= 0) {
    const int plain = nodal.shared.first_special;
    add({name + ", that nothing but elements concerns", 0, plain}, Stage::motion, MotionLanes::early_nodes,
        Begins::after_elements);
    add({name + ", that others concern", plain, all}, Stage::other_motion, 0);
    return tasks;
  }
  if (early > 0)
    add({name + ", beside what others wait for", 0, early}, Stage::motion, MotionLanes::early_nodes,
        early_nodes == EarlyNodes::apart ? Begins::after_own_forces : Begins::in_order);
  add({name, early, all}, Stage::other_motion, 0);
  return tasks;
}

RankNodeTasks rank_node_tasks(const NodalState& nodal, const LoadModel& loads) {
  const std::string name = "nodes that element blocks share";
  const IndexRange& between = nodal.between_ranks;
  const auto tasks = [&](const std::string& which, int begin, int end) {
    return placed_nodes(nodal, loads, false, {name + which, begin, end}, Stage::other_motion, 0, Begins::in_order);
  };
  // All ranks wait for these: plain ones have no launch of their own beside others.
  const SharedRange several{name + ", of several ranks", between.begin, between.end};
  const bool mixed = between.begin < nodal.shared.first_special && nodal.shared.first_special < between.end;
  return {tasks(", of this rank alone", 0, between.begin), tasks(", of this rank alone", between.end, nodal.first_late),
          mixed ? placed({shared_task(nodal, loads, false, several)}, Stage::other_motion, 0)
                : tasks(", of several ranks", between.begin, between.end),
          tasks(", that wait for others", nodal.first_late, static_cast<int>(nodal.shared.nodes.extent(0)))};
}

}  // namespace railwave
