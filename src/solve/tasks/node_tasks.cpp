#include "kernels/nodes/shared_nodes.hpp"
#include "model/boundaries/prescribed_nodes.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/carriers.hpp"
#include "solve/tasks.hpp"
#include "solve/tasks/beam_forces.hpp"
#include "solve/tasks/contributions.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {

NodeAdvance node_advance(const Model& model, double step) {
  const Vec3& g = model.scene.gravity;
  return {model.nodes, {{g[0], g[1], g[2]}}, model.velocity_lag + 0.5 * step, step};
}

namespace {

/// With subcycling: the nodes whose own step begins now.
Task paced_task(const Model& model, bool shared_alone) {
  return {"nodes in phase", "f to j", [&model, shared_alone](const Instant& instant) {
            const int phase = model.subcycling.phase(model.step);
            PacedNodeUpdate update{model.paced_acceleration(), node_advance(model, instant.step), {}};
            update.acceleration.phase = phase;
            if (shared_alone) update.shared = model.shared_nodes;
            const int count = shared_alone ? model.subcycling.shared_end[phase] : model.nodes.count;
            if (count > 0) Kokkos::parallel_for("paced_nodes", Range(0, count), update);
          }};
}

/// Nodes in single precision that belong to one block alone.
Task carried_blocks_task(const Model& model) {
  return {"inner nodes of the elements' blocks", "f to j", [&model](const Instant& instant) {
            for (const ElementGroup& group : model.elements)
              launch_blocks(group.blocks,
                            CarriedBlockUpdate{group.blocks, carried_advance(model, group.carried, instant.step),
                                               model.partial.in_single, group.first_partial});
          }};
}

/// @param rows_are_due the loads that follow from sets are left to the nodes that feel them
Task carried_shared_task(const Model& model, bool rows_are_due) {
  return {"nodes that element blocks share", "f to j", [&model, rows_are_due](const Instant& instant) {
            Kokkos::parallel_for(
                "shared_nodes", Range(0, static_cast<int>(model.shared_nodes.extent(0))),
                CarriedSharedUpdate{model.acceleration(), carried_advance(model, {}, instant.step), model.shared_nodes,
                                    model.carried.shared_arm, row_loads(model, instant.elapsed), rows_are_due});
          }};
}

Task shared_task(const Model& model, bool rows_are_due) {
  return {"nodes that element blocks share", "f to j", [&model, rows_are_due](const Instant& instant) {
            Kokkos::parallel_for("shared_nodes", Range(0, static_cast<int>(model.shared_nodes.extent(0))),
                                 SharedNodeUpdate{model.acceleration(), node_advance(model, instant.step),
                                                  model.shared_nodes, row_loads(model, instant.elapsed), rows_are_due});
          }};
}

Task node_task(const Model& model) {
  return {"nodes", "f to j", [&model](const Instant& instant) {
            Kokkos::parallel_for("node_update", Range(0, model.nodes.count),
                                 NodeUpdate{model.acceleration(), node_advance(model, instant.step)});
          }};
}

Task prescribed_task(const Model& model, const PrescribedSet& set) {
  return {"prescribed motion of " + set.motion->target, "g", [&model, &set](const Instant& instant) {
            Kokkos::parallel_for("prescribed_motion", Range(0, static_cast<int>(set.nodes.extent(0))),
                                 prescribed_motion(model, set, instant.step));
          }};
}

}  // namespace

Task tied_nodes_task(Model& model, StepKind kind) {
  const bool carried = model.carried.active() && kind != StepKind::settling;
  return {"tied nodes", "g", [&model, carried](const Instant& instant) {
            const TieFollow follow{model.ties.arrays, model.nodes, instant.step};
            const SpreadRange slaves(0, model.ties.arrays.slave_count);
            if (carried)
              Kokkos::parallel_for(
                  "ties", slaves,
                  CarriedTieFollow{follow, carried_advance(model, {}, instant.step).nodes, model.ties.carrier});
            else
              Kokkos::parallel_for("ties", slaves, follow);
          }};
}

std::vector<Task> motion_tasks(Model& model, StepKind kind) {
  const bool inner_have_moved = kind == StepKind::advancing, rows_are_due = sets_go_along(model, kind);
  std::vector<Task> tasks;
  for (const PrescribedSet& set : model.prescribed) tasks.push_back(prescribed_task(model, set));
  if (model.beams)
    tasks.push_back(
        {"rotations of beams", "f to j", [&model](const Instant& instant) { advance_rotations(model, instant.step); }});
  if (model.subcycling.levels > 1) {
    tasks.push_back(paced_task(model, inner_have_moved));
  } else if (model.carried.active()) {
    if (!inner_have_moved) tasks.push_back(carried_blocks_task(model));
    tasks.push_back(carried_shared_task(model, rows_are_due));
  } else {
    tasks.push_back(inner_have_moved ? shared_task(model, rows_are_due) : node_task(model));
  }
  if (model.ties.arrays.active()) tasks.push_back(tied_nodes_task(model, kind));
  return tasks;
}

}  // namespace railwave
