#include "output/progress.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ostream>

#include "model/contact/contact_law.hpp"
#include "model/model.hpp"
#include "solve/statics/settle.hpp"

namespace railwave {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void Progress::begin(const Model& model) {
  ProgressPlan plan;
  plan.element_count = model.element_count();
  plan.updates_saved = model.subcycling.gain();
  plan.end_time = model.scene.time.end;
  plan.interval = model.scene.output.progress_interval;
  for (const auto& contact : model.scene.contacts) {
    plan.contacts.push_back(describe_contact(contact));
    plan.algorithms.push_back(describe_algorithm(contact));
  }
  table_ = std::make_unique<ProgressTable>(out_, std::move(plan), wall_seconds);
}

void Progress::doubts(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) out_ << "warning: " << line << '\n';
  out_ << std::flush;
}

void Progress::settling(const Model& model, const SettleReport& so_far) {
  const double now = wall_seconds();
  if (now - last_settling_line_ < model.scene.output.progress_interval) return;
  last_settling_line_ = now;
  out_ << fmt::format("settling: {} evaluations of the forces, unbalanced force {:.2e} of all forces\n", so_far.steps,
                      so_far.unbalance)
       << std::flush;
}

void Progress::settled(const Model& model, const SettleReport& report) {
  const double tolerance = model.scene.settle.tolerance;
  for (const std::string& remark : report.remarks) out_ << remark << '\n';
  if (!report.begun_from.empty()) out_ << fmt::format("settling went on from the state of {}\n", report.begun_from);
  if (!report.taken_from.empty()) {
    out_ << fmt::format("settled state of {} taken: unbalanced force {:.2e} of all forces (settle.tolerance {:.2e})\n",
                        report.taken_from, report.unbalance, tolerance)
         << std::flush;
    return;
  }
  const std::string in_steps =
      report.iterations > 0 ? fmt::format(" in {} steps of Newton's method", report.iterations) : "";
  out_ << fmt::format(
      "{} after {} evaluations of the forces{}, {:.2f} s: unbalanced force {:.2e} of all forces (settle.tolerance "
      "{:.2e})\n",
      report.settled ? "settled" : "NOT settled", report.steps, in_steps, report.wall_seconds, report.unbalance,
      tolerance);
  if (!report.adrift.empty()) out_ << "  " << report.adrift << '\n';
  if (!report.settled)
    out_ << "  the run starts from there and will ring; raise settle.max_steps, or hold what can drift away\n";
  out_ << std::flush;
}

void Progress::history(const Model&, const HistorySample& sample) { table_->history(sample); }

void Progress::warning(const Model&, const Fault& fault) {
  out_ << (fault.fatal ? "FAULT: " : "warning: ") << fault.summary() << '\n' << std::flush;
}

void Progress::end(const Model&, const RunSummary& summary) { table_->end(summary); }

}  // namespace railwave
