#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "solve/observer.hpp"

namespace railwave {

/// What the progress table must know of a run before it begins.
struct ProgressPlan {
  long element_count = 0;
  double updates_saved = 1;                       ///< so many times fewer element updates than elements times steps
  double end_time = 0;                            ///< s
  double interval = 5;                            ///< wall seconds between lines; 0: a line for every history sample
  std::vector<std::string> contacts, algorithms;  ///< of each its name, and which algorithm it has
};

/// Prints how a run goes: a line now and then, and a summary at its end. Plain text, knows no model.
class ProgressTable {
 public:
  using Clock = std::function<double()>;  ///< wall seconds since some instant

  ProgressTable(std::ostream& out, ProgressPlan plan, Clock clock);

  void history(const HistorySample& sample);
  void end(const RunSummary& summary);

 private:
  struct ForceSample {
    double time = 0;
    double normal = 0, tangential = 0;  ///< N, sizes of the sums over the contact
  };
  void note(const HistorySample& sample);
  void print_line(const HistorySample& sample, double now);
  void print_energies() const;
  void print_contacts() const;

  std::ostream& out_;
  ProgressPlan plan_;
  Clock clock_;
  double start_ = 0, last_line_ = 0, first_time_ = 0;
  long first_step_ = -1, last_line_step_ = 0, samples_ = 0, lines_ = 0;
  long keep_every_ = 1;                           ///< of the samples; grows so that memory does not
  std::vector<std::vector<ForceSample>> forces_;  ///< by contact
  HistorySample last_;
  double largest_energy_ = 0, largest_elastic_energy_ = 0, largest_balance_error_ = 0;
};

/// "1 h 02 min", "3 min 05 s", "12 s".
std::string duration_text(double seconds);

/// Shows on `out` how a run goes: a line every scene.output.progress_interval wall seconds, and a summary.
class Progress : public RunObserver {
 public:
  explicit Progress(std::ostream& out) : out_(out) {}

  void begin(const Model& model) override;
  void doubts(const std::vector<std::string>& lines) override;
  void settling(const Model& model, const SettleReport& so_far) override;
  void settled(const Model& model, const SettleReport& report) override;
  void history(const Model& model, const HistorySample& sample) override;
  bool looks_at_model() const override { return false; }
  void warning(const Model& model, const Fault& fault) override;
  void end(const Model& model, const RunSummary& summary) override;

 private:
  std::ostream& out_;
  std::unique_ptr<ProgressTable> table_;
  double last_settling_line_ = 0;
};

}  // namespace railwave
