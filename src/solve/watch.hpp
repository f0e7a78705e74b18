#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solve/diagnosis.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// Looks at a run for what can't be right: scene.watch has the limits, docs/watch.md the table. All that it measures on the
/// device it measures at looks, which are rare; an inactive watch knows of values that are not finite only.
class Watch {
 public:
  explicit Watch(const Model& model);

  /// Whether it wants to look at this step: every 512 steps, at the first powers of two, and every 32 once something is odd.
  bool due(long step) const;

  /// Where a sample's part energies are wanted; null: nowhere.
  std::vector<PartEnergy>* part_energies(long step) { return arrays_ && due(step) ? &by_part_ : nullptr; }

  /// Judges the present instant.
  /// @param sample with its balance error
  /// @return what is new
  std::vector<Fault> look(const HistorySample& sample);

  /// What must stop the run; null: nothing.
  const Fault* fatal() const;

  /// Everything found, the first of each kind with the worst since.
  const std::vector<Fault>& found() const { return found_; }

  /// Lines for the summary.
  std::vector<std::string> told() const;

 private:
  void look_at_model(const HistorySample& sample);
  void look_at_energies(const HistorySample& sample);
  void look_at_parts(const HistorySample& sample);
  void note(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample, Extreme where, bool at_element);
  void place_at_element(Fault& fault, int element) const;
  void place_at_node(Fault& fault, int node) const;
  bool finite(const HistorySample& sample) const;

  const Model& model_;
  std::unique_ptr<WatchArrays> arrays_;  ///< null in an inactive watch
  WatchEvidence evidence_;
  bool begun_ = false, odd_ = false;
  double given_at_start_ = 0, given_ = 0;  ///< J
  std::vector<PartEnergy> by_part_, most_of_part_;
  std::vector<Fault> found_;
  std::vector<Fault> new_;
};

}  // namespace railwave
