#pragma once

#include <functional>
#include <memory>

#include "solve/launch_order.hpp"
#include "solve/plan.hpp"

namespace railwave {

class RowExchange;

/// Advancing steps whose launches are recorded as graphs, several steps a graph, where Kokkos can record them
/// (solve/launch_graph.hpp), or the messages between ranks' devices can. Then a GPU doesn't wait for the host between
/// launches, and tasks in different lanes run side by side. Each kernel computes what it computes when launched by
/// itself, so that results are bit for bit those of plain steps.
class StepRecording {
 public:
  /// @param plan of the steps: of what its tasks hold references to, all must outlive this
  /// @param order in which graphs are launched; must outlive this
  /// @param exchange of a rank's steps, which must outlive this, too; null: there is one rank
  StepRecording(Model& model, const Plan& plan, LaunchOrder& order, RowExchange* exchange = nullptr);
  ~StepRecording();

  /// Steps of the largest graph; 0: all steps are plain.
  int most() const;

  /// Launches several steps. The clock stays as it is.
  /// @param quiet steps, the present one first, in which nothing is due but the plan
  /// @param time s, of a step
  /// @return how many were launched; 0: this step must be plain
  long advance(const Instant& instant, long quiet, const std::function<double(long)>& time);

  /// Graphs in a space of their own that the device has not come to the end of.
  long graphs_ahead() const;
  /// Whether the host would wait for them before it launches the next one.
  bool would_wait() const;

  /// Before anything else is launched that concerns the model: waits for the graphs of a space of their own.
  /// @param idle the device has nothing left to do when the next graph comes
  void finish(bool idle = true);

  /// Before steps with other inputs or arrays than those that were recorded. Finishes too.
  void forget();

 private:
  struct Recordings;
  std::unique_ptr<Recordings> recordings_;
};

}  // namespace railwave
