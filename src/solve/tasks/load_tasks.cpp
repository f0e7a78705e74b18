#include <fmt/format.h>

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

using LoadTeams = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<most_threads_of_sets>, AsArgument>;

/// Connectors and torques, and the loads of nodes that feel nothing else.
Task set_load_task(const NodalState& nodal, const LoadModel& loads, StepKind kind) {
  const bool connectors = loads.connectors.arrays.count > 0, torques = loads.torques.count > 0;
  const bool rows = loads.set_teams.rows.extent(0) > 0;
  return {fmt::format("{}{}",
                      connectors && torques ? "connectors, torques"
                      : connectors          ? "connectors"
                      : torques             ? "torques"
                                            : "motion of sets",
                      rows ? ", gather of loads" : ""),
          "a", [&nodal, &loads, kind](const Instant& instant) {
            const SetTeams& teams = loads.set_teams;
            LoadTeams policy(instant.space(), teams.count, teams.threads);
            policy.set_scratch_size(0, Kokkos::PerTeam(teams.scratch_size()));
            Kokkos::parallel_for("set_loads", policy, set_loads(nodal, loads, instant, kind));
          }};
}

/// Connectors and torques after other loads, then the gather of those rows that more than one team of SetLoads or beams
/// concern.
std::vector<Task> gathered_tasks(const NodalState& nodal, const LoadModel& loads, StepKind kind,
                                 std::vector<Task> others) {
  std::vector<Task> tasks = std::move(others);
  if (loads.sets.moving > 0) tasks.push_back(set_load_task(nodal, loads, kind));
  const Array<LoadedRow*>& rows = loads.set_teams.others;
  if (rows.extent(0) == 0) return tasks;
  const char* const name = nodal.external.contribution_count == 0 ? "clearing of loads"
                           : loads.set_teams.rows.extent(0) > 0   ? "gather of other loads"
                                                                  : "gather of loads";
  Task gather{
      name, "a", [&nodal, &loads, &rows](const Instant& instant) {
        const ListedRowLoads all{row_loads(nodal, loads, instant.elapsed), rows, loads.set_teams.others_with_few};
        SumTeams policy(instant.space(), all.teams(), threads_of_sum);
        policy.set_scratch_size(0, Kokkos::PerTeam(ListedRowLoads::scratch_size()));
        Kokkos::parallel_for("row_loads", policy, all);
      }};
  gather.joins = OwnForceLanes::beams;
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
