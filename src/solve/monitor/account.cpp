#include "solve/monitor/account.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/loads/load_sums.hpp"
#include "kernels/monitor/monitor_terms.hpp"
#include "model/elements/element_histories.hpp"
#include "model/sample_sums.hpp"
#include "solve/monitor/energies.hpp"
#include "solve/tasks/beam_forces.hpp"

namespace railwave {
namespace {

/// Kinetic energy at t_n, m v(n-1/2).v(n+1/2)/2, and minus the work of gravity. From the two velocities, not from
/// m (|v_n|^2 - |step a/2|^2)/2: of nodes that begin to move nothing but rounding would be left. Along prescribed
/// directions a is 0 here: see PrescribedWork.
struct NodalEnergy {
  static constexpr int values = values_of_node_parts;
  SubcycledAcceleration acceleration;
  double lag, step;

  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const double steps = acceleration.levels.steps(n);
    const Vector3 a = steps * acceleration(n);
    const Vector3 stored = row(nodes.velocity, n);
    sum[0] += 0.5 * nodes.mass(n) * dot(stored + (lag - 0.5 * step) * a, stored + (lag + 0.5 * step) * a);
    sum[1] += nodes.mass(n) * dot(acceleration.plain.gravity, row(nodes.position, n) - row(nodes.reference, n));
  }
};

/// Weighted displacement, velocity and acceleration at t_n of a set's nodes.
struct MeanMotionSum {
  static constexpr int values = values_of_motion_parts;
  SubcycledAcceleration acceleration;
  Array<const int*> node;
  Array<const double* [2]> weight;
  Array<const int*> driven;  ///< empty: no prescribed motion moves any of them
  Array<const double* [6]> driven_change;
  double lag;
  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const int n = node(k);
    const double of_place = weight(k, 0), of_motion = weight(k, 1);
    const Vector3 moved = row(nodes.position, n) - row(nodes.reference, n);
    for (int i = 0; i < 3; ++i) sum[i] += of_place * moved[i];
    if (of_motion == 0) return;  // a tied node has next to no mass: its own acceleration may be no number
    Vector3 a = acceleration.plain(n);
    const Vector3 own = acceleration.levels.level.extent(0) == 0 ? a : acceleration(n);
    Vector3 v = row(nodes.velocity, n) + (acceleration.levels.steps(n) * lag) * own;
    if (const int r = driven.extent(0) > 0 ? driven(k) : -1; r >= 0) {
      for (int i = 0; i < 3; ++i) {
        v[i] += driven_change(r, i);
        a[i] += driven_change(r, 3 + i);
      }
    }
    for (int i = 0; i < 3; ++i) {
      sum[3 + i] += of_motion * v[i];
      sum[6 + i] += of_motion * a[i];
    }
  }
};

/// Everything that account_energies() gives, into `energy`, when the sums are fetched. Parts get theirs by
/// share_out_energies(). Of nodes and elements the sums of all parts must be there.
void queue_energies(const Model& model, double step, EnergyAccount& energy, bool by_part, SampleSums& sums) {
  const auto external = [&energy](const double* sum) { energy.external_work += *sum; };
  queue_lists<NodalEnergy::values>(model.node_parts, sums, [&energy](int, const double* sum) {
    energy.kinetic += sum[0];
    energy.external_work += sum[1];
  });
  queue_element_energies(model, energy, by_part, sums);
  queue_contact_energies(model.contacts, energy, sums);
  if (!model.loads.empty()) sums.sum(ArraySum{model.external.work}, model.external.contribution_count, external);
  for (const PrescribedSet& set : model.prescribed)
    sums.sum(PrescribedWork{prescribed_motion(model, set, 0), prescribed_instant(model, set)},
             static_cast<int>(set.nodes.extent(0)), [&energy](const double* sum) {
               energy.external_work += sum[0];
               energy.kinetic += sum[1];
             });
  if (model.ends.arrays.count > 0)
    sums.sum(NonReflectingEnergy{model.ends.arrays, model.nodes.position}, model.ends.arrays.count,
             [&energy](const double* sum) {
               energy.damping += sum[0];
               energy.external_work += sum[1];
             });
  if (model.beams) queue_beam_energies(model, model.beams->arrays, step, energy, sums);
  if (model.connectors.arrays.count > 0)
    sums.sum(ConnectorEnergy{model.connectors.arrays.energy}, model.connectors.arrays.count,
             [&energy](const double* sum) {
               energy.connector += sum[0];
               energy.damping += sum[1];
             });
}

}  // namespace

namespace {

void sum_nodal_energies(const Model& model, double step, const ExecutionSpace& order) {
  sum_parts(model.node_parts, NodalEnergy{model.subcycled_acceleration(), model.velocity_lag, step}, order);
}

}  // namespace

std::vector<Task> energy_sum_tasks(const Model& model) {
  const Task nodes{"energies of nodes", "",
                   [&model](const Instant& instant) { sum_nodal_energies(model, instant.step, instant.space()); }};
  Task elements{"energies of elements", "",
                [&model](const Instant& instant) { sum_block_energies(model, model.nodes, instant.space()); }};
  elements.begins = Begins::beside_loads;
  std::vector<Task> tasks = placed({nodes}, Stage::sums, 0);
  append(tasks, placed({std::move(elements)}, Stage::sums, 1));
  return tasks;
}

void sum_own_parts(const Model& model, SampledSums what, double step, const ExecutionSpace& order) {
  if (what == SampledSums::energies) {
    sum_nodal_energies(model, step, order);
    sum_block_energies(model, model.nodes, order);
  } else {
    const MotionHistories& histories = model.motion_histories;
    sum_parts(histories.parts,
              MeanMotionSum{model.subcycled_acceleration(), histories.node, histories.weight, histories.driven,
                            histories.driven_change, model.velocity_lag},
              order);
    sum_element_parts(model, model.nodes, order);
  }
}

namespace {

/// Of this process and of the others.
void sum_all_parts(const Model& model, SampledSums what, double step, SampledRanks* others,
                   const ExecutionSpace& order) {
  if (others != nullptr) others->begin_sums(what, step);
  sum_own_parts(model, what, step, order);
  if (others != nullptr) others->take_sums(what);
}

}  // namespace

EnergyAccount account_energies(const Model& model, double step) {
  EnergyAccount energy;
  sum_own_parts(model, SampledSums::energies, step);
  SampleSums sums(*model.reduction_space);
  queue_energies(model, step, energy, false, sums);
  sums.fetch();
  return energy;
}

double balance_total(const EnergyAccount& energy) {
  return energy.kinetic + energy.internal + energy.hourglass + energy.contact + energy.friction + energy.connector +
         energy.damping + energy.plastic - energy.external_work;
}

double deformation_energy(const EnergyAccount& energy) {
  return std::fabs(energy.internal) + std::fabs(energy.hourglass) + std::fabs(energy.contact) +
         std::fabs(energy.friction) + std::fabs(energy.connector) + std::fabs(energy.damping) +
         std::fabs(energy.plastic);
}

double largest_energy(const EnergyAccount& energy) {
  return std::max({std::fabs(energy.kinetic), std::fabs(energy.internal), std::fabs(energy.hourglass),
                   std::fabs(energy.contact), std::fabs(energy.friction), std::fabs(energy.connector),
                   std::fabs(energy.damping), std::fabs(energy.plastic), std::fabs(energy.external_work)});
}

namespace {

/// How prescribed motions move their nodes at the present instant, where histories need that.
void find_driven_changes(const NodalState& nodal, const MotionHistories& histories, const ExecutionSpace& order) {
  if (histories.driven.extent(0) == 0) return;
  int first = 0;
  for (const PrescribedSet& set : nodal.prescribed) {
    const int count = static_cast<int>(set.nodes.extent(0));
    Kokkos::parallel_for("motion_of_driven_nodes", Range(order, 0, count),
                         PrescribedChange{prescribed_instant(nodal, set), set.nodes, histories.driven_rows, first,
                                          histories.driven_change});
    first += count;
  }
}

/// Means of all histories of motion, when the sums are fetched.
void queue_mean_motions(const PartedLists& parts, std::vector<MeanMotion>& means, SampleSums& sums) {
  means.resize(parts.list_count());
  queue_lists<MeanMotionSum::values>(parts, sums, [&means](int set, const double* sum) {
    for (int i = 0; i < 3; ++i) {
      means[set].displacement[i] = sum[i];
      means[set].velocity[i] = sum[3 + i];
      means[set].acceleration[i] = sum[6 + i];
    }
  });
}

}  // namespace

namespace {

/// What histories need besides what the monitor does, when the sums are fetched.
void queue_history_values(const Model& model, double step, HistorySample& sample, SampledRanks* others,
                          SampleSums& sums) {
  // Nodes that a prescribed motion moves are rank 0's, as all of their blocks are.
  find_driven_changes(model, model.motion_histories, sums.order());
  sum_all_parts(model, SampledSums::histories, step, others, sums.order());
  queue_mean_motions(model.motion_histories.parts, sample.sets, sums);
  queue_element_means(model, sample.elements, sums);
  queue_load_totals(model, model, model.beams, sample.loads, sums);
  queue_reactions(model, sample.reactions, sums);
  if (model.beams) queue_beam_resultants(*model.beams, model.nodes, sample.beams, sums);
}

/// What the present instant's sample has when the sums are fetched, those of energies by parts being there; contacts of
/// each pair into `pairs`.
void queue_sample(const Model& model, double step, bool by_part, SampledRanks* others, bool with_histories,
                  HistorySample& sample, std::vector<ContactTotals>& pairs, SampleSums& sums) {
  sample.time = model.time;
  sample.step = model.step;
  pairs.resize(model.contacts.size());
  queue_energies(model, step, sample.energy, by_part, sums);
  for (std::size_t c = 0; c < pairs.size(); ++c) queue_pair_totals(model, model.contacts[c], pairs[c], sums);
  if (with_histories) queue_history_values(model, step, sample, others, sums);
}

/// The halves of symmetric contacts together.
void join_halves(const std::vector<ContactPair>& contacts, std::vector<ContactTotals>& pairs, HistorySample& sample) {
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const ContactPair& pair = contacts[c];
    if (pair.reversed) continue;
    if (pair.partner >= 0) add_other_half(pairs[c], pairs[pair.partner]);
    sample.contacts.push_back(pairs[c]);
  }
}

/// All that is asked for is waited for once.
HistorySample sample_at(const Model& model, double step, std::vector<PartEnergy>* by_part, SampledRanks* others,
                        bool with_histories) {
  HistorySample sample;
  std::vector<ContactTotals> pairs;
  SampleSums sums(*model.reduction_space);
  sum_all_parts(model, SampledSums::energies, step, others, sums.order());
  queue_sample(model, step, by_part != nullptr, others, with_histories, sample, pairs, sums);
  sums.fetch();
  if (by_part != nullptr) share_out_energies(model.assembly, model.elements, *by_part);
  join_halves(model.contacts, pairs, sample);
  return sample;
}

}  // namespace

HistorySample sample_for_monitor(const Model& model, double step, std::vector<PartEnergy>* by_part,
                                 SampledRanks* others) {
  return sample_at(model, step, by_part, others, false);
}

void add_history_values(const Model& model, double step, HistorySample& sample, SampledRanks* others) {
  SampleSums sums(*model.reduction_space);
  queue_history_values(model, step, sample, others, sums);
  sums.fetch();
}

HistorySample take_sample(const Model& model, double step, std::vector<PartEnergy>* by_part, SampledRanks* others) {
  return sample_at(model, step, by_part, others, true);
}

SampleUnderWay::SampleUnderWay(const Model& model, double step, const What& what, const ExecutionSpace& order)
    : model_(model), by_part_(what.by_part), sums_(*model.reduction_space, order) {
  if (!what.energies_summed) sum_own_parts(model, SampledSums::energies, step, order);
  queue_sample(model, step, by_part_ != nullptr, nullptr, what.histories, sample_, pairs_, sums_);
  sums_.launch();
}

void SampleUnderWay::send(Milestone& done) { sums_.start_fetch(done); }

HistorySample SampleUnderWay::finish(const Milestone& done) {
  sums_.finish_fetch(done);
  if (by_part_ != nullptr) share_out_energies(model_.assembly, model_.elements, *by_part_);
  join_halves(model_.contacts, pairs_, sample_);
  return std::move(sample_);
}

}  // namespace railwave
