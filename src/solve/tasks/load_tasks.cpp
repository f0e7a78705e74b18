#include <algorithm>

#include "solve/tasks/beam_forces.hpp"
#include "solve/tasks/contributions.hpp"

namespace railwave {
namespace {

/// A load that puts the values of its contributions in place by a kernel of its own.
void apply_load(const NodalState& nodal, const LoadArrays& load, const Instant& instant) {
  const StepValue<double> value = instant.value_of(load);
  const NodeArrays& nodes = nodal.nodes;
  if (load.load->type == scene::LoadType::pressure) {
    Kokkos::parallel_for(
        "pressure", Range(instant.space(), 0, load.count),
        PressureLoad{nodal.external, nodes.position, nodes.velocity, load.first, load.facets, value, instant.elapsed});
  } else {
    Kokkos::parallel_for("dead_load", Range(instant.space(), 0, load.count),
                         DeadLoad{nodal.external, nodes.velocity, load.first, load.amplitude, value, instant.elapsed});
  }
}

constexpr int threads_of_loads = on_device ? 512 : 1;
using LoadTeam = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<512>, AsArgument>;

/// Sums over sets, and what follows from them.
void launch_set_loads(const ExecutionSpace& space, const SetLoads& all) {
  if (few_sets(all.sets.sets)) return Kokkos::parallel_for("set_loads", LoadTeam(space, 1, threads_of_loads), all);
  Kokkos::parallel_for("set_chunks", SpreadRange(space, 0, all.chunk_count()), SetChunkSums{all.sets});
  Kokkos::parallel_for("set_sums", SpreadRange(space, 0, all.sum_count()), SetSums{all.sets});
  Kokkos::parallel_for("set_laws", SpreadRange(space, 0, all.law_count()), SetLaws{all});
}

/// Connectors and torques.
/// @param rows how many are gathered in the same launch
Task set_load_task(const NodalState& nodal, const LoadModel& loads, StepKind kind, int rows) {
  const bool connectors = loads.connectors.arrays.count > 0, torques = loads.torques.count > 0;
  return {connectors && torques ? "connectors, torques"
          : connectors          ? "connectors"
          : torques             ? "torques"
                                : "motion of sets",
          "a", [&nodal, &loads, kind, rows](const Instant& instant) {
            launch_set_loads(instant.space(), set_loads(nodal, loads, instant, kind, rows));
          }};
}

Task gather_task(const NodalState& nodal, const LoadModel& loads) {
  return {nodal.external.contribution_count > 0 ? "gather of loads" : "clearing of loads", "a",
          [&nodal, &loads](const Instant& instant) {
            Kokkos::parallel_for("row_loads", SpreadRange(instant.space(), 0, nodal.external.loaded_count),
                                 row_loads(nodal, loads, instant.elapsed));
          }};
}

/// Of connectors, torques and all other loads: one launch where they are few. Sums over many sets come before all else.
std::vector<Task> gathered_tasks(const NodalState& nodal, const LoadModel& loads, StepKind kind,
                                 std::vector<Task> others) {
  Task gather = gather_task(nodal, loads);
  std::vector<Task> tasks;
  if (loads.sets.moving > 0 && few_rows(loads.sets, nodal.external)) {
    const std::string name = gather.name;
    gather = set_load_task(nodal, loads, kind, nodal.external.loaded_count);
    gather.name += ", " + name;
  } else if (loads.sets.moving > 0) {
    tasks.push_back(set_load_task(nodal, loads, kind, 0));
  }
  gather.joins = OwnForceLanes::beams;
  append(tasks, std::move(others));
  tasks.push_back(std::move(gather));
  return tasks;
}

}  // namespace

std::vector<Task> load_tasks(const NodalState& nodal, const LoadModel& loads, const std::shared_ptr<BeamModel>& beams,
                             StepKind kind, GoingAlong along) {
  std::vector<Task> of_beams, tasks;
  if (beams) of_beams.push_back(beam_task(nodal, *beams, kind));
  if (beams && kind == StepKind::advancing) of_beams.push_back(rotation_task(nodal, *beams));
  for (const LoadArrays& load : loads.loads)
    if (load.torque < 0 && load.beam_node < 0)
      tasks.push_back({"load " + load.load->name, "a",
                       [&nodal, &load](const Instant& instant) { apply_load(nodal, load, instant); }});
  if (nodal.external.loaded_count > 0 && !along.sets) tasks = gathered_tasks(nodal, loads, kind, std::move(tasks));
  std::vector<Task> all = placed(std::move(of_beams), Stage::own_forces, OwnForceLanes::beams);
  append(all, placed(std::move(tasks), Stage::own_forces, OwnForceLanes::loads));
  return all;
}

std::vector<Task> non_reflecting_tasks(const NodalState& nodal, const NonReflectingEnds& ends, StepKind kind) {
  if (ends.arrays.count == 0 || kind == StepKind::settling) return {};
  return {{"non-reflecting ends", "a", [&nodal, &ends](const Instant& instant) {
             NonReflectingForce force{ends.arrays, nodal.subcycled_acceleration(), nodal.velocity_lag, instant.elapsed};
             force.acceleration.phase = nodal.subcycling.phase(nodal.step);
             Kokkos::parallel_for("non_reflecting", SpreadRange(instant.space(), 0, ends.arrays.count), force);
           }}};
}

std::vector<Task> tie_tasks(const NodalState& nodal, const Ties& ties) {
  if (!ties.arrays.active()) return {};
  Task force{"forces of ties", "a", [&nodal, &ties](const Instant& instant) {
               Kokkos::parallel_for("tie_force", SpreadRange(instant.space(), 0, ties.arrays.slave_count),
                                    TieForce{ties.arrays, nodal.acceleration().force});
             }};
  Task gather{"gather of ties", "a", [&nodal, &ties](const Instant& instant) {
                const TieArrays& arrays = ties.arrays;
                Kokkos::parallel_for("tie_gather", SumTeams(instant.space(), 3 * arrays.master_count, threads_of_sum),
                                     TieGather{arrays, arrays.master_rows, nodal.external.sum.load, ties.unloaded});
              }};
  if (ties.unloaded) force.begins = gather.begins = Begins::beside_loads;
  return placed({std::move(force), std::move(gather)}, Stage::passed_on, 0);
}

}  // namespace railwave
