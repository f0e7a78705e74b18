#pragma once

#include <iosfwd>
#include <memory>

#include "output/progress_table.hpp"

namespace railwave {

/// Shows on `out` how a run goes: a line every scene.output.progress_interval wall seconds, and a summary.
class Progress : public RunObserver {
 public:
  explicit Progress(std::ostream& out) : out_(out) {}

  void begin(const Model& model) override;
  void doubts(const std::vector<std::string>& lines) override;
  void settling(const Model& model, const SettleReport& so_far) override;
  void settled(const Model& model, const SettleReport& report) override;
  void history(const Model& model, const HistorySample& sample) override;
  void warning(const Model& model, const Fault& fault) override;
  void end(const Model& model, const RunSummary& summary) override;

 private:
  std::ostream& out_;
  std::unique_ptr<ProgressTable> table_;
  double last_settling_line_ = 0;
};

}  // namespace railwave
