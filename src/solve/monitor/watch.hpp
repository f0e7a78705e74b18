#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "solve/checkpoint/run_state.hpp"
#include "solve/monitor/diagnosis.hpp"
#include "solve/monitor/end_watch.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// Looks at a run for what can't be right: scene.watch has the limits, docs/watch.md the table. All that it measures on
/// the device it measures at looks, which are rare; an inactive watch knows of values that are not finite only.
class Watch {
 public:
  Watch(const AssembledScene& assembled, const NodalState& nodal, const StepSizes& sizes, const LoadModel& loads,
        const std::vector<ContactPair>& contacts);

  /// Whether it wants to look at this step: 64 times a run, but no oftener than every 512 steps and no rarer than every
  /// 4096; at the first powers of two; every 32 while something odd grows; after a glance that saw a contact come to an
  /// end of its surface; and at the energies alone 24 times at least, but no oftener than every 32 steps.
  bool due(long step) const;

  /// Where a sample's part energies are wanted; null: nowhere.
  std::vector<PartEnergy>* part_energies(long step) { return arrays_ && whole_due(step) ? &by_part_ : nullptr; }

  /// Glances at the ends of contact surfaces, where it is time: every 256 steps, after the forces. Much less than a
  /// look, and no other step than any.
  void glance();

  /// Judges the present instant.
  /// @param sample with its balance error
  /// @return what is new
  std::vector<Fault> look(const HistorySample& sample);

  /// What must stop the run; null: nothing.
  const Fault* fatal() const;

  /// Lines for the summary: everything found, the first of each kind with the worst since.
  std::vector<std::string> told() const;

  /// How well the energy account was kept: what a run that completes may claim.
  std::string account_told() const;

  /// A line for each contact that never closed.
  std::vector<std::string> never_closed() const;

  /// The worst value of each kind and its limit, whether passed or not, under the names that the keys of [watch] have.
  std::string worst_told() const;

  /// All that it remembers: a run that is taken up again warns as the unbroken one.
  void archive(StateTaker& state) { archive_all(state); }
  void archive(StateLayer& state) { archive_all(state); }

 private:
  struct Worst {
    double value = 0, limit = 0, time = 0;  ///< s
    bool seen = false;
  };
  /// Energies of a part, J.
  struct WatchedPart {
    double deformation = 0;                        ///< elastic and plastic, the most so far
    double stored = 0;                             ///< by hourglass control, the most so far
    double dissipated_lately = 0;                  ///< by it, within about a millisecond
    double hourglass_before = 0, time_before = 0;  ///< at the last look; s
  };
  /// Something beyond its limit: its least value since a step; -1: it is not beyond.
  struct Lasting {
    double least = 0;
    long since = -1;
  };
  struct Limits {
    double warning, fatal = std::numeric_limits<double>::infinity();
  };

  void look_at_beginning(const HistorySample& sample);
  void look_at_model(const HistorySample& sample);
  double floor_of_error(const HistorySample& sample) const;
  void weigh_energies(const HistorySample& sample);
  void look_at_energies(const HistorySample& sample);
  void look_at_parts(const HistorySample& sample);
  void judge_lasting(FaultKind kind, double value, Limits limits, Lasting& lasting, const HistorySample& sample);
  void look_at_ends(const HistorySample& sample);
  void judge_contact(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample,
                     std::size_t contact, int node, const std::string& told);
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
  std::unique_ptr<WatchArrays> arrays_;  ///< null in an inactive watch
  WatchEvidence evidence_;
  std::unique_ptr<EndWatch> ends_;  ///< null in an inactive watch, and without contacts
  bool begun_ = false, odd_ = false;
  bool wants_look_ = false;  ///< a glance saw something new
  double given_at_start_ = 0,
         given_ = 0;  ///< J: what the run began with, and that with the most that loads have worked
  double deformation_ =
      0;  ///< J, the most so far that deformation held and had dissipated, less what the balance says was made
  double impacts_ = 0;                    ///< J, the most so far that impacts on multipliers had taken
  double work_ = 0;                       ///< J, the most that loads have worked
  double energy_of_rounding_ = 0;         ///< J, of elements in single precision
  double energy_of_rest_ = 0;             ///< J, of rounded places, in a step
  double rate_at_start_ = 0;              ///< 1/s, at which the fastest turning body begins to turn
  double share_ = 0, kinetic_share_ = 0;  ///< error of the balance, and kinetic energy beyond what was given, beyond
                                          ///< what they can't help, over `deformation_`
  double share_before_ = 0;               ///< the first, at the last of the regular looks
  bool blown_up_ = false;                 ///< the error is as large beside all that was given, travel included
  Lasting lasting_error_, lasting_growth_;
  std::array<Worst, fault_kinds> worst_;  ///< by kind
  std::vector<PartEnergy> by_part_;
  std::vector<WatchedPart> parts_;
  std::vector<Fault> found_;
  std::vector<Fault> new_;  ///< of the present look
};

}  // namespace railwave
