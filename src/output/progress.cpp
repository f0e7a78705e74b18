#include "output/progress.hpp"

#include <chrono>

#include "model/model.hpp"

namespace railwave {
namespace {

double wall_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

void Progress::begin(const Model& model) {
  ProgressPlan plan;
  plan.element_count = model.element_count();
  plan.step_count = model.step_count;
  plan.end_time = model.scene.time.end;
  plan.interval = model.scene.output.progress_interval;
  for (const auto& contact : model.scene.contacts) plan.contacts.push_back(contact.name);
  table_ = std::make_unique<ProgressTable>(out_, std::move(plan), wall_seconds);
}

void Progress::history(const Model&, const HistorySample& sample) { table_->history(sample); }

void Progress::end(const Model&, const RunSummary& summary) { table_->end(summary); }

}  // namespace railwave
