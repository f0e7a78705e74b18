#include "model/elements/carriers.hpp"
#include "solve/tasks.hpp"
#include "solve/tasks/contributions.hpp"

namespace railwave {
namespace {

/// Before all else: nodes in single precision, and the double ones where these are read.
Task carrier_task(Model& model, StepKind kind) {
  return {"carriers of nodes in single precision", "j", [&model, kind](const Instant& instant) {
            if (!model.carried.begun)
              take_nodes_over(model);
            else if (kind == StepKind::sampled)
              give_nodes_back(model);
            lay_carrier_steps(model, instant.step);
          }};
}

/// A load that puts the values of its contributions in place by a kernel of its own.
void apply_load(const Model& model, const LoadArrays& load, const Instant& instant) {
  const double factor = curve_value(load.curve, instant.time);
  const NodeArrays& nodes = model.nodes;
  if (load.load->type == scene::LoadType::pressure) {
    Kokkos::parallel_for("pressure", Range(0, load.count),
                         PressureLoad{model.extra, nodes.position, nodes.velocity, load.first, load.facets,
                                      factor * load.load->pressure, instant.elapsed});
  } else {
    Kokkos::parallel_for("dead_load", Range(0, load.count),
                         DeadLoad{model.extra, nodes.velocity, load.first, load.amplitude, factor, instant.elapsed});
  }
}

using LoadTeam = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<512>, AsArgument>;

/// Sums over sets, and what follows from them.
void launch_set_loads(const Model& model, const SetLoads& all) {
  if (few_sets(model)) return Kokkos::parallel_for("set_loads", LoadTeam(1, on_device ? 512 : 1), all);
  Kokkos::parallel_for("set_chunks", SpreadRange(0, all.chunk_count()), SetChunks{all});
  Kokkos::parallel_for("set_sums", SpreadRange(0, all.sum_count()), SetSums{all});
  Kokkos::parallel_for("set_laws", SpreadRange(0, all.law_count()), SetLaws{all});
}

/// Connectors, torques, and the gather of all loads: one launch where they are few.
Task set_load_task(Model& model, StepKind kind) {
  const bool sets = model.sets.moving > 0, rows_go_along = sets && few_rows(model);
  std::string name = model.extra.contribution_count > 0 ? "gather of loads" : "clearing of loads";
  if (model.torques.count > 0) name = "torques, " + name;
  if (model.connectors.arrays.count > 0) name = "connectors, " + name;
  const int rows = model.extra.loaded_count;
  return {name, "a", [&model, kind, sets, rows_go_along, rows](const Instant& instant) {
            if (sets) launch_set_loads(model, set_loads(model, instant, kind, rows_go_along ? rows : 0));
            if (!rows_go_along)
              Kokkos::parallel_for("row_loads", SpreadRange(0, rows), row_loads(model, instant.elapsed));
          }};
}

}  // namespace

std::vector<Task> load_tasks(Model& model, StepKind kind) {
  std::vector<Task> tasks;
  if (model.carried.active() && kind != StepKind::settling) tasks.push_back(carrier_task(model, kind));
  for (const LoadArrays& load : model.loads)
    if (load.torque < 0 && load.beam_node < 0)
      tasks.push_back({"load " + load.load->name, "a",
                       [&model, &load](const Instant& instant) { apply_load(model, load, instant); }});
  if (model.beams) tasks.push_back(beam_task(model, kind));
  if (model.extra.loaded_count > 0 && !sets_go_along(model, kind)) tasks.push_back(set_load_task(model, kind));
  return tasks;
}

std::vector<Task> non_reflecting_tasks(Model& model, StepKind kind) {
  if (model.ends.arrays.count == 0 || kind == StepKind::settling) return {};
  return {
      {"non-reflecting ends", "a", [&model](const Instant& instant) {
         NonReflectingForce force{model.ends.arrays, model.paced_acceleration(), model.velocity_lag, instant.elapsed};
         force.acceleration.phase = model.subcycling.phase(model.step);
         Kokkos::parallel_for("non_reflecting", SpreadRange(0, model.ends.arrays.count), force);
       }}};
}

std::vector<Task> tie_tasks(Model& model) {
  if (!model.ties.arrays.active()) return {};
  return {{"ties", "a", [&model](const Instant&) {
             const TieArrays& ties = model.ties.arrays;
             Kokkos::parallel_for("tie_force", SpreadRange(0, ties.slave_count),
                                  TieForce{ties, model.acceleration().force});
             Kokkos::parallel_for("tie_gather", SumTeams(3 * ties.master_count, threads_of_sum),
                                  TieGather{ties, ties.master_rows, model.extra.sum.load});
           }}};
}

}  // namespace railwave
