#include "solve/run_summary.hpp"

#include <algorithm>

#include "model/sets/place_element_sets.hpp"
#include "model/sets/place_sets.hpp"
#include "model/subcycling.hpp"
#include "model/time_step/stable_step.hpp"
#include "solve/tasks/contact_window.hpp"

namespace railwave {
namespace {

void summarize_steps(const Model& model, const StepControl& control, RunSummary& summary) {
  summary.step_size = model.step_size;
  summary.smallest_step = control.smallest();
  summary.largest_step = control.largest();
  summary.step_renewals = control.renewals();
  summary.step_estimates = describe_stable_step(model);
  summary.subcycling = describe_subcycling(model);
  summary.time = model.time;
  summary.steps = model.step;
  const double updates = static_cast<double>(model.element_count()) *
                         static_cast<double>(model.step - summary.first_step) / model.subcycling.gain();
  summary.element_steps_per_second = updates / std::max(summary.wall_seconds, 1e-9);
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

void summarize_run(const Model& model, const StepControl& control, const Watch& watch,
                   const std::vector<ForceSwing>& swings, const std::vector<std::string>& doubts, RunSummary& summary) {
  const std::vector<std::string> checkpoint_trouble = summary.warnings;
  summary.completed = summary.reason.empty();
  summary.left_out = model.left_out;
  summarize_steps(model, control, summary);
  summary.account = watch.account_told();
  summary.watched = watch.worst_told();
  summary.warnings = watch.told();
  append(summary.warnings, watch.never_closed());
  append(summary.warnings, late_contacts(model));
  append(summary.warnings, checkpoint_trouble);
  for (const PlacedSet& placed : placed_sets(model.scene, model.assembly))
    if (!placed.warning.empty()) summary.warnings.push_back(placed.warning);
  append(summary.warnings, doubts);
  for (const PlacedElements& placed : placed_element_sets(model.scene, model.assembly))
    if (!placed.warning.empty()) summary.warnings.push_back(placed.warning);
  for (std::size_t c = 0; c < swings.size(); ++c)
    if (const std::string line = swings[c].told(model.scene.contacts[c].name); !line.empty())
      summary.swings.push_back(line);
}

}  // namespace railwave
