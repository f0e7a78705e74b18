#include "output/progress.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "case/memory.hpp"
#include "output/histories/history_values.hpp"

namespace railwave {
namespace {

constexpr std::size_t most_force_samples = 20000;
constexpr long lines_between_headings = 30;

double size(const Vec3& vector) { return std::hypot(vector[0], vector[1], vector[2]); }

/// "3.4 %", "0.012 %"; "-" where there is nothing to compare with.
std::string share(double part, double whole) { return whole > 0 ? fmt::format("{:.2g} %", 100 * part / whole) : "-"; }

std::string memory_text(const std::vector<double>& memory) {
  std::vector<std::string> each;
  for (double bytes : memory) each.push_back(bytes_text(bytes));
  return fmt::format("memory taken at most{}: {}", each.size() > 1 ? ", by rank" : "", fmt::join(each, ", "));
}

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "?";
  const long whole = std::lround(seconds);
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return seconds < 10 ? fmt::format("{:.1f} s", seconds) : fmt::format("{} s", whole);
}

ProgressTable::ProgressTable(std::ostream& out, ProgressPlan plan, Clock clock)
    : out_(out), plan_(std::move(plan)), clock_(std::move(clock)), forces_(plan_.contacts.size()) {}

void ProgressTable::note(const HistorySample& sample) {
  last_ = sample;
  const EnergyAccount& energy = sample.energy;
  for (const EnergyTerm& term : energy_terms)
    if (term.value != &EnergyAccount::balance_error)
      largest_energy_ = std::max(largest_energy_, std::fabs(energy.*term.value));
  largest_elastic_energy_ = std::max(largest_elastic_energy_, energy.internal + energy.contact);
  // Not std::max: once it is not a number, it is to stay so.
  if (!(std::fabs(energy.balance_error) <= largest_balance_error_))
    largest_balance_error_ = std::fabs(energy.balance_error);

  if (samples_++ % keep_every_ != 0) return;
  for (std::size_t i = 0; i < forces_.size() && i < sample.contacts.size(); ++i)
    forces_[i].push_back(
        {sample.time, size(sample.contacts[i].normal_force), size(sample.contacts[i].tangential_force)});
  if (forces_.empty() || forces_[0].size() < most_force_samples) return;
  keep_every_ *= 2;
  for (auto& series : forces_) {
    for (std::size_t i = 0; 2 * i < series.size(); ++i) series[i] = series[2 * i];
    series.resize((series.size() + 1) / 2);
  }
}

void ProgressTable::history(const HistorySample& sample) {
  const double now = clock_();
  if (first_step_ < 0) {
    // Counted from here: what the run did before its first step says nothing of the time left.
    first_step_ = last_line_step_ = sample.step;
    first_time_ = sample.time;
    start_ = last_line_ = now;
  }
  note(sample);
  if (lines_ > 0 && now - last_line_ < plan_.interval) return;
  print_line(sample, now);
}

void ProgressTable::print_line(const HistorySample& sample, double now) {
  const bool contact = !plan_.contacts.empty() && !sample.contacts.empty();
  if (lines_ % lines_between_headings == 0) {
    out_ << fmt::format("{:>10} {:>11} {:>6} {:>8} {:>12}", "step", "time", "done", "Mel-st/s", "left");
    if (contact) out_ << fmt::format(" {:>9} {:>9}", "normal", "tangent.");
    out_ << fmt::format(" {:>10} {:>10} {:>10} {:>10} {:>10} {:>8}\n", "kinetic", "internal", "hourglass", "contact",
                        "friction", "balance");
    out_ << fmt::format("{:>10} {:>11} {:>6} {:>8} {:>12}", "", "ms", "%", "", "");
    if (contact) out_ << fmt::format(" {:>9} {:>9}", "kN", "kN");
    out_ << fmt::format(" {:>10} {:>10} {:>10} {:>10} {:>10} {:>8}\n", "J", "J", "J", "J", "J", "%");
  }
  const double done = plan_.end_time > 0 ? std::min(1.0, sample.time / plan_.end_time) : 0;
  const long steps = sample.step - last_line_step_;
  const double updates = static_cast<double>(plan_.element_count) * static_cast<double>(steps) / plan_.updates_saved;
  const double rate = now > last_line_ ? updates / (now - last_line_) : 0;
  // By time: the step may change as the run goes.
  const std::string left =
      plan_.end_time > 0 && sample.time > first_time_
          ? duration_text((now - start_) * std::max(0.0, plan_.end_time - sample.time) / (sample.time - first_time_))
          : "-";
  out_ << fmt::format("{:>10} {:>11.5f} {:>6.1f} {:>8} {:>12}", sample.step, 1e3 * sample.time, 100 * done,
                      rate > 0 ? fmt::format("{:.1f}", 1e-6 * rate) : "-", left);
  if (contact)
    out_ << fmt::format(" {:>9.3f} {:>9.3f}", 1e-3 * size(sample.contacts[0].normal_force),
                        1e-3 * size(sample.contacts[0].tangential_force));
  const EnergyAccount& energy = sample.energy;
  out_ << fmt::format(" {:>10.4g} {:>10.4g} {:>10.3g} {:>10.3g} {:>10.3g} {:>8}\n", energy.kinetic, energy.internal,
                      energy.hourglass, energy.contact, energy.friction,
                      largest_energy_ > 0 ? fmt::format("{:.1g}", 100 * energy.balance_error / largest_energy_) : "-");
  out_.flush();
  last_line_ = now;
  last_line_step_ = sample.step;
  ++lines_;
}

void ProgressTable::print_energies() const {
  out_ << "  energies at the end, J\n";
  for (const EnergyTerm& term : energy_terms)
    if (term.value != &EnergyAccount::balance_error)
      out_ << fmt::format("    {:<16} {:>14.6g}\n", term.name, last_.energy.*term.value);
  out_ << fmt::format("  energy balance error, J: {:.4g} at the end, {:.4g} at most\n", last_.energy.balance_error,
                      largest_balance_error_);
  out_ << fmt::format(
      "    the most, of the largest energy ({:.6g} J): {}; of the largest elastic energy ({:.6g} J): {}\n",
      largest_energy_, share(largest_balance_error_, largest_energy_), largest_elastic_energy_,
      share(largest_balance_error_, largest_elastic_energy_));
}

void ProgressTable::print_contacts() const {
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    if (forces_[i].empty()) continue;
    const double from = forces_[i].front().time + 0.8 * (forces_[i].back().time - forces_[i].front().time);
    double normal = 0, tangential = 0, count = 0;
    for (const ForceSample& sample : forces_[i]) {
      if (sample.time < from) continue;
      normal += sample.normal;
      tangential += sample.tangential;
      ++count;
    }
    normal /= count;
    tangential /= count;
    out_ << fmt::format("  contact {}, mean over the last fifth: normal {:.3f} kN, tangential {:.3f} kN",
                        plan_.contacts[i], 1e-3 * normal, 1e-3 * tangential);
    if (normal > 0) out_ << fmt::format(", traction coefficient {:.4f}", tangential / normal);
    if (i < plan_.algorithms.size()) out_ << fmt::format(" ({})", plan_.algorithms[i]);
    out_ << '\n';
  }
}

void ProgressTable::end(const RunSummary& summary) {
  out_ << '\n'
       << (summary.completed ? std::string("completed") : fmt::format("NOT completed: {}", summary.reason)) << '\n';
  out_ << fmt::format("  reached {:.6g} ms of {:.6g} ms in {} steps of {:.4g} us\n", 1e3 * summary.time,
                      1e3 * plan_.end_time, summary.steps, 1e6 * summary.step_size);
  if (summary.smallest_step < summary.largest_step)
    out_ << fmt::format("  steps between {:.4g} and {:.4g} us, the stable step renewed {} times\n",
                        1e6 * summary.smallest_step, 1e6 * summary.largest_step, summary.step_renewals);
  if (!summary.account.empty()) out_ << "  " << summary.account << '\n';
  for (const std::string& line : summary.warnings) out_ << "  warning: " << line << '\n';
  for (const std::string& line : summary.swings) out_ << "  " << line << '\n';
  for (const std::string& line : summary.step_estimates) out_ << "  step " << line << '\n';
  for (const std::string& line : summary.subcycling) out_ << "  subcycling: " << line << '\n';
  if (!summary.memory.empty() && summary.memory[0] > 0) out_ << "  " << memory_text(summary.memory) << '\n';
  if (!summary.ranks.empty()) out_ << "  " << summary.ranks << '\n';
  out_ << fmt::format("  wall time {}, {:.2f} million element-steps per second ({} elements)\n",
                      duration_text(summary.wall_seconds), 1e-6 * summary.element_steps_per_second,
                      plan_.element_count);
  if (!summary.worst_values.empty())
    out_ << fmt::format("  monitor, worst values (limits): {}\n    its checks took {:.2g} s, {:.2g} % of the run\n",
                        summary.worst_values, summary.monitor_seconds,
                        100 * summary.monitor_seconds / std::max(summary.wall_seconds, 1e-9));
  if (summary.output_seconds > 0)
    out_ << fmt::format("  outputs took {:.3g} s, {:.2g} % of the run\n", summary.output_seconds,
                        100 * summary.output_seconds / std::max(summary.wall_seconds, 1e-9));
  if (summary.checkpoints > 0)
    out_ << fmt::format("  {} checkpoints, for which the run waited {:.3g} s in all, {:.2g} % of its time\n",
                        summary.checkpoints, summary.checkpoint_seconds,
                        100 * summary.checkpoint_seconds / std::max(summary.wall_seconds, 1e-9));
  if (samples_ > 0) {
    print_energies();
    print_contacts();
  }
  if (!summary.left_out.empty()) {
    out_ << "  left out, because the scene does not need it\n";
    for (const std::string& what : summary.left_out) out_ << "    " << what << '\n';
  }
  out_.flush();
}

}  // namespace railwave
