#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/assembled_scene.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/nodal_state.hpp"
#include "model/time_step/step_sizes.hpp"
#include "solve/monitor/fault.hpp"

namespace railwave {

struct BeamModel;
class ForceSwing;
class StepControl;
class Monitor;
struct SceneAsMade;

/// How a run ended.
struct RunSummary {
  bool completed = false;
  std::string reason;             ///< when not completed: interrupted, or what went wrong
  bool out_of_time = false;       ///< it ended because its wall-time budget was spent
  int checkpoints = 0;            ///< written
  double checkpoint_seconds = 0;  ///< s, the loop waited for these in all
  double monitor_seconds = 0;     ///< s, that checks of the monitor added to the run
  double output_seconds = 0;      ///< s, that histories, fields and contact outputs added to it
  std::string account;            ///< how well the energy account was kept, or that nobody judged it
  std::string worst_values;       ///< the worst values that it saw, and their limits; empty: it saw nothing
  long first_step = 0;            ///< at which this process took the run up; 0 unless restarted
  double time = 0;
  long steps = 0;
  double step_size = 0;                        ///< s, the last one
  double smallest_step = 0, largest_step = 0;  ///< s
  int step_renewals = 0;                       ///< of the global estimate of the stable step
  std::vector<std::string> step_estimates;     ///< what each estimate of the stable step allows, and which one counts
  std::vector<std::string> subcycling;  ///< how many elements are of which level, and what that saves; none without it
  double wall_seconds = 0;
  double element_steps_per_second = 0;  ///< of the element updates that were made
  std::vector<std::string> swings;      ///< where the run began unsettled: how its contact forces oscillated
  std::vector<double> memory;           ///< bytes, by rank: the most that each process has taken
  std::string ranks;                  ///< of a run over several: how rows went, what came to rank 0; empty: one process
  std::optional<Fault> fault;         ///< what stopped it, if the monitor did
  std::vector<std::string> warnings;  ///< what may have cost accuracy
  std::vector<std::string> left_out;  ///< what the scene did not need and the run did not compute
};

/// Completes what the summary of a run that has ended says of its steps. It holds already from where the run began, and
/// its wall time.
void summarize_steps(const AssembledScene& assembled, const NodalState& nodal, const StepSizes& sizes,
                     const std::shared_ptr<BeamModel>& beams, const StepControl& control, RunSummary& summary);

/// Completes account, warnings and swings of a run that has ended. The summary holds already why it ended, its fault,
/// and what went wrong with its checkpoints.
/// @param doubts lines that were reported when the run began
void summarize_findings(const AssembledScene& assembled, const SceneAsMade& made,
                        const std::vector<ContactPair>& contacts, const Monitor& monitor,
                        const std::vector<ForceSwing>& swings, const std::vector<std::string>& doubts,
                        RunSummary& summary);

}  // namespace railwave
