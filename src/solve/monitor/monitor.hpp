#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "solve/checkpoint/run_state.hpp"
#include "solve/monitor/diagnosis.hpp"
#include "solve/monitor/end_monitor.hpp"
#include "solve/monitor/sampled_ranks.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// scene_as_made.cpp: what a run asks of the whole mesh, found before it begins: on several ranks none has the whole
/// mesh then.
struct SceneAsMade {
  // Of the monitor, where it is active:
  Extreme worst_shape;            ///< smallest Jacobian at a corner over the mean of its element; element
  double energy_of_rounding = 0;  ///< J, elastic, of what rounding strains elements in single precision by
  double energy_of_rest = 0;  ///< J, elastic, of what the rounding of places strains elements by: what a scene at rest
                              ///< has of energies, and takes in a step
  double energy_of_places = 0;  ///< J, that the same rounding makes or takes in a step of gravity's work and of springs

  // Lines of the summary about sets that were asked for by position:
  std::vector<std::string> node_set_warnings, element_set_warnings;

  explicit SceneAsMade(const AssembledScene& assembled);
};

/// Monitors a run for what can't be right: scene.monitor has the limits, docs/monitor.md the table. All that it
/// measures on the device it measures at checks, which are rare; an inactive monitor knows of values that are not
/// finite only.
class Monitor {
 public:
  /// @param own of a run over several ranks: what this process measures; null: all
  Monitor(const AssembledScene& assembled, const NodalState& nodal, const StepSizes& sizes, const LoadModel& loads,
          const std::vector<ContactPair>& contacts, const SceneAsMade& made, const OwnItems* own = nullptr,
          SampledRanks* others = nullptr);

  /// Whether a check is due at this step: 64 times a run, but no oftener than every 512 steps and no rarer than every
  /// 4096; at the first powers of two; every 32 while something odd grows, or where a check of contacts' ends has found
  /// one at an end of its surface; and at the energies alone 24 times at least, but no oftener than every 32
  /// steps, and 48 to 96 times in a long run.
  bool due(long step) const;

  /// From what shows something odd to the check that is due for that, at the steps that are multiples of it.
  static constexpr long steps_when_odd = 32;

  /// Where a sample's part energies may be wanted, as a check of contacts' ends at the same step can ask for a whole
  /// one; null: nowhere.
  std::vector<PartEnergy>* part_energies(long step) {
    return arrays_ && (whole_due(step) || contact_ends_due(step)) ? &by_part_ : nullptr;
  }

  /// Checks the ends of contact surfaces, where it is time: every 256 steps, after the forces. That costs much less
  /// than a check of the model, and the step stays as any. Where a check of the model is due, that has them. What was
  /// asked for may be taken some steps later.
  /// @param step of which it is
  void check_contact_ends(long step);
  /// Before the checks of this step: asks the device for all that they have of it, so that it is waited for once, or
  /// later.
  /// @param order in which the launches come
  /// @param sampled whether check() will get a sample of this step
  void ask(const ExecutionSpace& order, bool sampled) {
    if (contact_ends_due(nodal_.step)) ends_->ask(order);
    if (sampled && arrays_ && whole_due(nodal_.step)) arrays_->ask(nodal_, contacts_, order);
  }
  /// Whether the device has yet to come to that.
  bool waits() const { return (ends_ && ends_->waits()) || (arrays_ && arrays_->waits()); }
  bool contact_ends_due(long step) const { return ends_ && step % EndMonitor::steps_between == 0; }
  /// Whether this step's check may ask where whole parts are: then no node may have been moved on before it.
  bool asks_for_places(long step) const { return contact_ends_due(step) && ends_->may_ask_for_places(); }

  /// Judges the present instant.
  /// @param sample with its balance error
  /// @return what is new
  std::vector<Fault> check(const HistorySample& sample);

  /// What must stop the run; null: nothing.
  const Fault* fatal() const;

  /// Lines for the summary: everything found, the first of each kind with the worst since.
  std::vector<std::string> summary() const;

  /// How well the energy account was kept: what a run that completes may claim.
  std::string account_summary() const;

  /// A line for each contact that never closed.
  std::vector<std::string> never_closed() const;

  /// The worst value of each kind and its limit, whether passed or not, under the names that the keys of [monitor]
  /// have.
  std::string worst_summary() const;

  /// All that it remembers: a run that is taken up again warns as the unbroken one.
  void archive(StateSaver& state) { archive_all(state); }
  void archive(StateRestorer& state) { archive_all(state); }

 private:
  struct Worst {
    double value = 0, limit = 0, time = 0;  ///< s
    bool seen = false;
  };
  /// Energies of a part, J.
  struct MonitoredPart {
    double deformation = 0;                        ///< elastic and plastic, the most so far
    double stored = 0;                             ///< by hourglass control, the most so far
    double dissipated_lately = 0;                  ///< by it, within about a millisecond
    double hourglass_before = 0, time_before = 0;  ///< at the last check; s
  };
  /// Something beyond its limit: its least value since a step; -1: it is not beyond.
  struct Lasting {
    double least = 0;
    long since = -1;
  };
  struct Limits {
    double warning, fatal = std::numeric_limits<double>::infinity();
  };

  void check_beginning(const HistorySample& sample);
  void check_model(const HistorySample& sample);
  double floor_of_error(const HistorySample& sample) const;
  void weigh_energies(const HistorySample& sample);
  void check_energies(const HistorySample& sample);
  void check_parts(const HistorySample& sample);
  void judge_lasting(FaultKind kind, double value, Limits limits, Lasting& lasting, const HistorySample& sample);
  void check_ends(const HistorySample& sample);
  void judge_contact(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample,
                     std::size_t contact, int node, const std::string& text);
  bool knows(FaultKind kind, const std::string& contact) const;
  void judge(FaultKind kind, double value, Limits limits, const HistorySample& sample, Extreme where,
             bool at_element = false);
  void note(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample, Extreme where,
            bool at_element);
  void add(Fault fault);
  void place_at_element(Fault& fault, int element) const;
  void place_at_node(Fault& fault, int node) const;
  bool finite(const HistorySample& sample) const;
  bool regular(long step) const;
  bool whole_due(long step) const;
  bool energies_due(long step) const;
  template <class Archive>
  void archive_all(Archive& archive);

  const AssembledScene& assembled_;
  const NodalState& nodal_;
  const StepSizes& sizes_;
  const LoadModel& loads_;
  const std::vector<ContactPair>& contacts_;
  SampledRanks* const others_;             ///< null: this process has the whole model
  std::unique_ptr<MonitorArrays> arrays_;  ///< null in an inactive monitor
  MonitorEvidence evidence_;
  std::unique_ptr<EndMonitor> ends_;  ///< null in an inactive monitor, and without contacts
  bool begun_ = false, odd_ = false;
  bool wants_check_ = false;  ///< the check of contacts' ends found something new
  double given_at_start_ = 0,
         given_ = 0;  ///< J: what the run began with, and that with the most that loads have worked
  double deformation_ =
      0;  ///< J, the most so far that deformation held and had dissipated, less what the balance says was made
  double impacts_ = 0;                    ///< J, the most so far that impacts on multipliers had taken
  double work_ = 0;                       ///< J, the most that loads have worked
  double energy_of_rounding_ = 0;         ///< J, see SceneAsMade
  double energy_of_rest_ = 0;             ///< J, the same
  double energy_of_places_ = 0;           ///< J, the same
  double rate_at_start_ = 0;              ///< 1/s, at which the fastest turning body begins to turn
  double share_ = 0, kinetic_share_ = 0;  ///< error of the balance, and kinetic energy beyond what was given, beyond
                                          ///< what they can't help, over `deformation_`
  double share_before_ = 0;               ///< the first, at the last of the regular checks
  bool blown_up_ = false;                 ///< the error is as large beside all that was given, travel included
  Lasting lasting_error_, lasting_growth_;
  std::array<Worst, fault_kinds> worst_;  ///< by kind
  std::vector<PartEnergy> by_part_;
  std::vector<MonitoredPart> parts_;
  std::vector<Fault> found_;
  std::vector<Fault> new_;  ///< of the present check
};

}  // namespace railwave
