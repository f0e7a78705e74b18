#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"
#include "solve/tasks.hpp"

namespace railwave {

class RowExchange;

/// What a step does, in order. It is made once, when the model is built, and holds only what the scene needs.
struct Plan {
  std::vector<Task> forces;  ///< of an instant
  std::vector<Task> motion;  ///< of the nodes, from that instant to the next
};

/// Launches those tasks that are due at a step, each in a profiler's region of its name (Kokkos Tools).
void run_tasks(const std::vector<Task>& tasks, const Instant& instant, long step_number);

/// A line for each task: its step of table 2.1, its name, how often it is due.
std::vector<std::string> describe_plan(const Plan& plan);

/// Forces that follow from where the nodes are and how they move, not from other forces: loads, contact by springs,
/// elements; then the search of multipliers. Every way of evaluating forces begins with them.
/// @param locate the search of multipliers
/// @param exchange of a model that other ranks share; null: all elements are computed here
std::vector<Task> own_force_tasks(Model& model, StepKind kind, std::vector<Task> locate = {},
                                  RowExchange* exchange = nullptr);

/// What a rank computes besides elements, which these do not wait for: loads; contact by springs, and the search of
/// multipliers.
struct BesideElements {
  std::vector<Task> loads, contact;
};

/// Elements of a rank's blocks, their rows sent while the inner ones are computed, and those of others received.
std::vector<Task> shared_force_tasks(Model& model, StepKind kind, RowExchange& exchange, BesideElements beside);

/// What rank 0 moves besides: where a motion is prescribed, and beams; after all other nodes, those that are tied.
struct BesideNodes {
  std::vector<Task> before, after;
};

/// Motion of a rank's nodes.
std::vector<Task> rank_motion_tasks(Model& model, StepKind kind, RowExchange& exchange, BesideNodes beside);

/// All forces of an instant.
/// @param relaxation see multiplier_tasks
std::vector<Task> force_tasks(Model& model, StepKind kind, const RelaxationUpdate* relaxation = nullptr,
                              RowExchange* exchange = nullptr);

/// The plan of an advancing or a sampled step. The model must outlive it.
Plan make_plan(Model& model, StepKind kind, RowExchange* exchange = nullptr);

/// Takes a model from instant to instant by its plans.
class StepPlans {
 public:
  explicit StepPlans(Model& model, RowExchange* exchange = nullptr);
  StepPlans(NodalState& nodal, Plan advancing, Plan sampled);

  /// Forces of the present instant: those of a sampled step stand until `advance`.
  void compute_forces(const Instant& instant, StepKind kind);

  /// Who has computed them himself says so.
  void forces_computed(StepKind kind) { kind_ = kind; }

  /// Moves the nodes to the next instant by the plan that computed the forces, and the model's clock with them.
  void advance(const Instant& instant);

  /// The clock alone, for who has run the plan's motion himself.
  void advance_clock(const Instant& instant, long steps = 1);

  const Plan& of(StepKind kind) const { return kind == StepKind::advancing ? advancing_ : sampled_; }

 private:
  NodalState& nodal_;
  Plan advancing_, sampled_;
  StepKind kind_ = StepKind::sampled;
};

}  // namespace railwave
