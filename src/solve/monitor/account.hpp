#pragma once

#include "model/model.hpp"
#include "model/sample_sums.hpp"
#include "solve/monitor/sampled_ranks.hpp"
#include "solve/observer.hpp"
#include "solve/tasks.hpp"

namespace railwave {

/// Energies at the present instant, whose forces have been computed. Stored energies are functions of the state,
/// independent of the forces that move the nodes, so the balance tests the time integration:
/// kinetic v(n-1/2) M v(n+1/2) / 2, of what a prescribed motion moves v(n) M v(n) / 2, elastic stress and strain,
/// penalty and connector springs. `balance_error` is left zero: the time loop knows the start.
EnergyAccount account_energies(const Model& model, double step);

/// kinetic + stored + dissipated - external work: constant in an exact run.
double balance_total(const EnergyAccount& energy);

/// What deformation, contacts and connectors hold, and what was dissipated so far, J: all entries but kinetic energy
/// and the work of loads, which alone know of rigid travel.
double deformation_energy(const EnergyAccount& energy);

/// The largest of the account's entries.
double largest_energy(const EnergyAccount& energy);

ContactTotals contact_totals(const NodalState& nodal, const std::vector<ContactPair>& contacts, std::size_t number);

/// Sums this process's parts of what is sampled, see PartedLists and ElementGroup::block_sums.
/// @param order in which the launches come
void sum_own_parts(const Model& model, SampledSums what, double step, const ExecutionSpace& order = ExecutionSpace());

/// The same sums of energies, to come after a sampled step's forces and before its motion.
std::vector<Task> energy_sum_tasks(const Model& model);

/// The energies and contacts of a history row at the present instant: what the monitor checks.
/// @param by_part if not null: gets the energies of each part of the assembly
/// @param others null: this process has the whole model
HistorySample sample_for_monitor(const Model& model, double step, std::vector<PartEnergy>* by_part = nullptr,
                                 SampledRanks* others = nullptr);

/// Adds its sets, loads, reactions and beams.
void add_history_values(const Model& model, double step, HistorySample& sample, SampledRanks* others = nullptr);

/// Both.
HistorySample take_sample(const Model& model, double step, std::vector<PartEnergy>* by_part = nullptr,
                          SampledRanks* others = nullptr);

/// A sample that the device has yet to come to: the host may launch something else meanwhile.
class SampleUnderWay {
 public:
  struct What {
    bool histories = true;                       ///< also sets, loads, reactions and beams
    bool energies_summed = false;                ///< the tasks of energy_sum_tasks() have run
    std::vector<PartEnergy>* by_part = nullptr;  ///< gets the energies of each part; null: nobody wants them
  };

  /// @param order in which its launches come
  SampleUnderWay(const Model& model, double step, const What& what, const ExecutionSpace& order = ExecutionSpace());

  /// On its way to the host, behind all that has been launched.
  /// @param done is put there
  void send(Milestone& done);

  /// Waits for it. Nothing else of the model may have been sampled since. Once.
  HistorySample finish(const Milestone& done);

 private:
  const Model& model_;
  std::vector<PartEnergy>* const by_part_;
  SampleSums sums_;
  HistorySample sample_;
  std::vector<ContactTotals> pairs_;
};

}  // namespace railwave
