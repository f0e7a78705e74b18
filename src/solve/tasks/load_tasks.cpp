#include <algorithm>

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
  constexpr int most_teams = 64;
  const int teams = std::min(most_teams, (all.chunk_count() + threads_of_loads - 1) / threads_of_loads);
  Kokkos::parallel_for("set_loads", LoadTeam(space, teams, threads_of_loads), SetLoadTeams{all, teams});
}

/// Connectors, torques, and the gather of all loads: one launch where they are few.
Task set_load_task(const NodalState& nodal, const LoadModel& loads, StepKind kind) {
  const bool sets = loads.sets.moving > 0, rows_go_along = sets && few_rows(loads.sets, nodal.external);
  std::string name = nodal.external.contribution_count > 0 ? "gather of loads" : "clearing of loads";
  if (loads.torques.count > 0) name = "torques, " + name;
  if (loads.connectors.arrays.count > 0) name = "connectors, " + name;
  const int rows = nodal.external.loaded_count;
  return {name, "a", [&nodal, &loads, kind, sets, rows_go_along, rows](const Instant& instant) {
            const ExecutionSpace space = instant.space();
            if (sets) launch_set_loads(space, set_loads(nodal, loads, instant, kind, rows_go_along ? rows : 0));
            if (!rows_go_along)
              Kokkos::parallel_for("row_loads", SpreadRange(space, 0, rows), row_loads(nodal, loads, instant.elapsed));
          }};
}

}  // namespace

std::vector<Task> load_tasks(const NodalState& nodal, const LoadModel& loads, const std::shared_ptr<BeamModel>& beams,
                             StepKind kind, GoingAlong along) {
  std::vector<Task> tasks;
  for (const LoadArrays& load : loads.loads)
    if (load.torque < 0 && load.beam_node < 0)
      tasks.push_back({"load " + load.load->name, "a",
                       [&nodal, &load](const Instant& instant) { apply_load(nodal, load, instant); }});
  if (beams) tasks.push_back(beam_task(nodal, *beams, kind));
  if (nodal.external.loaded_count > 0 && !along.sets) tasks.push_back(set_load_task(nodal, loads, kind));
  return tasks;
}

std::vector<Task> non_reflecting_tasks(const NodalState& nodal, const NonReflectingEnds& ends, StepKind kind) {
  if (ends.arrays.count == 0 || kind == StepKind::settling) return {};
  return {{"non-reflecting ends", "a", [&nodal, &ends](const Instant& instant) {
             NonReflectingForce force{ends.arrays, nodal.subcycled_acceleration(), nodal.velocity_lag, instant.elapsed};
             force.acceleration.phase = nodal.subcycling.phase(nodal.step);
             Kokkos::parallel_for("non_reflecting", SpreadRange(0, ends.arrays.count), force);
           }}};
}

std::vector<Task> tie_tasks(const NodalState& nodal, const Ties& ties) {
  if (!ties.arrays.active()) return {};
  std::vector<Task> tasks = placed({{"forces of ties", "a",
                                     [&nodal, &ties](const Instant&) {
                                       Kokkos::parallel_for("tie_force", SpreadRange(0, ties.arrays.slave_count),
                                                            TieForce{ties.arrays, nodal.acceleration().force});
                                     }}},
                                   Stage::passed_on, 0);
  append(tasks, placed({{"gather of ties", "a",
                         [&nodal, &ties](const Instant&) {
                           const TieArrays& arrays = ties.arrays;
                           Kokkos::parallel_for("tie_gather", SumTeams(3 * arrays.master_count, threads_of_sum),
                                                TieGather{arrays, arrays.master_rows, nodal.external.sum.load});
                         }}},
                       Stage::last_forces, 0));
  return tasks;
}

}  // namespace railwave
