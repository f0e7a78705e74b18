#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace railwave {

/// What tasks must know of time.
struct Instant {
  double time = 0;     ///< s
  double step = 0;     ///< s to the next instant
  double elapsed = 0;  ///< s since the instant before; 0 at the first, and in the pseudo-time of settling
};

/// What a step is for decides what it computes, and how.
enum class StepKind {
  advancing,  ///< nothing is read at its instant: blocks may move the nodes that are theirs alone at once
  sampled,    ///< all forces of the instant are there for outputs and the monitor before any node moves
  settling    ///< on the way to static equilibrium, in pseudo-time
};

/// One piece of physics of a step, or several that one launch computes together.
struct Task {
  std::string name;                         ///< also of the profiler's region around it
  std::string step;                         ///< of the thesis's table 2.1: (a) loads ... (j) geometry
  std::function<void(const Instant&)> run;  ///< launches its kernels
  long every = 1;                           ///< steps from one launch to the next, with subcycling and for frames
  long at = 0;                              ///< in which of them it is launched

  bool due(long step_number) const { return step_number % every == at; }
};

/// What a step does, in order. It is made once, when the model is built, and holds only what the scene needs.
struct Plan {
  std::vector<Task> forces;  ///< of an instant
  std::vector<Task> motion;  ///< of the nodes, from that instant to the next
};

/// Launches those tasks that are due at a step, each in a profiler's region of its name (Kokkos Tools).
void run_tasks(const std::vector<Task>& tasks, const Instant& instant, long step_number);

/// A line for each task: its step of table 2.1, its name, how often it is due.
std::vector<std::string> describe_plan(const Plan& plan);

/// The plan of an advancing or a sampled step. The model must outlive it.
Plan make_plan(Model& model, StepKind kind);

/// Takes a model from instant to instant by its plans.
class StepPlans {
 public:
  explicit StepPlans(Model& model);

  /// Forces of the present instant: those of a sampled step stand until `advance`.
  void compute_forces(const Instant& instant, StepKind kind);

  /// Moves the nodes to the next instant by the plan that computed the forces, and the model's clock with them.
  void advance(const Instant& instant);

  /// The clock alone, for who has run the plan's motion himself.
  void advance_clock(const Instant& instant);

  const Plan& of(StepKind kind) const { return kind == StepKind::advancing ? advancing_ : sampled_; }

 private:
  Model& model_;
  Plan advancing_, sampled_;
  StepKind kind_ = StepKind::sampled;
};

}  // namespace railwave
