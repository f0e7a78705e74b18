#include "solve/run_summary.hpp"

#include <algorithm>

#include "model/subcycling.hpp"
#include "model/time_step/stable_step.hpp"
#include "solve/monitor/force_swing.hpp"
#include "solve/monitor/monitor.hpp"
#include "solve/step_control.hpp"
#include "solve/tasks.hpp"

namespace railwave {
namespace {

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

void summarize_steps(const AssembledScene& assembled, const NodalState& nodal, const StepSizes& sizes,
                     const std::shared_ptr<BeamModel>& beams, const StepControl& control, RunSummary& summary) {
  summary.step_size = sizes.step_size;
  summary.smallest_step = control.smallest();
  summary.largest_step = control.largest();
  summary.step_renewals = control.renewals();
  summary.step_estimates = describe_stable_step(assembled, sizes.stable_step, beams);
  summary.subcycling = describe_subcycling(assembled.scene, nodal.subcycling);
  summary.time = nodal.time;
  summary.steps = nodal.step;
  const double updates = static_cast<double>(assembled.element_count()) *
                         static_cast<double>(nodal.step - summary.first_step) / nodal.subcycling.gain();
  summary.element_steps_per_second = updates / std::max(summary.wall_seconds, 1e-9);
}

void summarize_findings(const AssembledScene& assembled, const SceneAsMade& made,
                        const std::vector<ContactPair>& contacts, const Monitor& monitor,
                        const std::vector<ForceSwing>& swings, const std::vector<std::string>& doubts,
                        RunSummary& summary) {
  const std::vector<std::string> checkpoint_trouble = summary.warnings;
  summary.account = monitor.account_summary();
  summary.worst_values = monitor.worst_summary();
  summary.warnings = monitor.summary();
  append(summary.warnings, monitor.never_closed());
  append(summary.warnings, late_contacts(contacts));
  append(summary.warnings, checkpoint_trouble);
  append(summary.warnings, made.node_set_warnings);
  append(summary.warnings, doubts);
  append(summary.warnings, made.element_set_warnings);
  for (std::size_t c = 0; c < swings.size(); ++c)
    if (const std::string line = swings[c].summary(assembled.scene.contacts[c].name); !line.empty())
      summary.swings.push_back(line);
}

}  // namespace railwave
