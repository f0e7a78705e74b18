#include "solve/monitor/account.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/monitor/monitor_terms.hpp"
#include "kernels/support/reductions.hpp"
#include "model/boundaries/prescribed_nodes.hpp"
#include "model/contact/contact_law.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/element_histories.hpp"
#include "model/elements/element_model.hpp"
#include "model/elements/materials.hpp"
#include "model/fields.hpp"
#include "model/host_copy.hpp"
#include "solve/tasks/beam_forces.hpp"

namespace railwave {
namespace {

/// Kinetic energy at t_n, m v(n-1/2).v(n+1/2)/2 = m (|v_n|^2 - |step a/2|^2)/2, and minus the work of gravity.
struct NodalEnergy {
  static constexpr int values = 2;
  SubcycledAcceleration acceleration;
  double lag, step;

  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const double steps = acceleration.levels.steps(n);
    const Vector3 a = steps * acceleration(n);
    const Vector3 v = row(nodes.velocity, n) + lag * a;
    sum[0] += 0.5 * nodes.mass(n) * (dot(v, v) - 0.25 * step * step * dot(a, a));
    sum[1] += nodes.mass(n) * dot(acceleration.plain.gravity, row(nodes.position, n) - row(nodes.reference, n));
  }
};

/// Elastic energy of the blocks, and what their hourglass control has stored or dissipated.
struct BlockEnergy {
  static constexpr int values = 2;
  Array<const double* [2]> energy;
  Array<const double*> dissipated;
  KOKKOS_INLINE_FUNCTION void operator()(int p, double* sum) const {
    sum[0] += energy(p, 0);
    sum[1] += energy(p, 1);
    for (int k = 0; k < power_sums; ++k) sum[1] += dissipated(p * power_sums + k);
  }
};

/// Work of plastic flow: a function of each element's history.
template <class S, class Material>
struct FlowWork {
  static constexpr int values = 1;
  Material material;
  Array<const int*> row;  ///< of the blocks' materials
  Array<const double*> volume;
  KOKKOS_INLINE_FUNCTION void operator()(int slot, double* sum) const {
    constexpr int kept = Material::history_values;
    double history[kept];
    for (int c = 0; c < kept; ++c) history[c] = material.history[tiled_slot<S>(slot, kept, c)];
    sum[0] += volume(slot) * Material::work(material.constants[row(slot / elements_of_block)], history);
  }
};

/// Adds the work of plastic flow of a block's slots to what the block has stored.
template <class OfSlot>
struct AddFlowWork {
  OfSlot of_slot;
  Array<double* [2]> energy;
  KOKKOS_INLINE_FUNCTION void operator()(const int p) const {
    double sum = 0;
    for (int slot = p * elements_of_block; slot < (p + 1) * elements_of_block; ++slot) of_slot(slot, &sum);
    energy(p, 0) += sum;
  }
};

/// Stored in the penalty springs; dissipated by friction, and by the law.
template <class Law>
struct ContactEnergy {
  static constexpr int values = 3;
  ContactArrays contact;
  Law law;
  Array<const double*> state;
  KOKKOS_INLINE_FUNCTION void operator()(int s, double* sum) const {
    sum[1] += contact.friction_energy(s);
    sum[2] += law.dissipated(LawState<Law>::of_node(state, contact.slave_count, s).values);
    if (contact.status(s) == status_apart) return;
    const Vector3 n = row(contact.normal_force, s), t = row(contact.tangential_force, s);
    sum[0] += law.stored({contact.gap(s), contact.segment_stiffness(contact.tracked(s))}, dot(n, n), dot(t, t));
  }
};

/// Taken out by the impacts of nodes whose forces are multipliers, and dissipated by friction.
struct MultiplierEnergy {
  static constexpr int values = 2;
  Array<const double*> impact_energy, friction_energy;
  KOKKOS_INLINE_FUNCTION void operator()(int s, double* sum) const {
    sum[0] += impact_energy(s);
    sum[1] += friction_energy(s);
  }
};

/// Sums over the slave's nodes: normal force, tangential force, what the shape functions pass on to the master; nodes
/// in contact, nodes that slip.
struct SlaveSums {
  static constexpr int values = 11;
  ContactArrays contact;
  KOKKOS_INLINE_FUNCTION void operator()(int s, double* sum) const {
    if (contact.status(s) == status_apart) return;
    double shares = 0;
    for (int k = 0; k < 4; ++k) shares += segment_shape(k, contact.place(s, 0), contact.place(s, 1));
    for (int i = 0; i < 3; ++i) {
      sum[i] += contact.normal_force(s, i);
      sum[3 + i] += contact.tangential_force(s, i);
      sum[6 + i] -= shares * (contact.normal_force(s, i) + contact.tangential_force(s, i));
    }
    sum[9] += 1;
    if (contact.status(s) == status_slips) sum[10] += 1;
  }
};

/// Contact forces found on the master's nodes.
struct MasterSums {
  static constexpr int values = 3;
  ExternalForceSum external;
  Array<const int*> external_row, nodes;
  KOKKOS_INLINE_FUNCTION void operator()(int m, double* sum) const {
    const Vector3 force = external.contact_force(external_row(nodes(m)));
    for (int i = 0; i < 3; ++i) sum[i] += force[i];
  }
};

/// Weighted displacement, velocity and acceleration at t_n of a set's nodes.
struct MeanMotionSum {
  static constexpr int values = 9;
  SubcycledAcceleration acceleration;
  NodeSets sets;
  int begin;
  double lag;
  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const int n = sets.nodes(begin + k);
    const double w = sets.weight(begin + k);
    const Vector3 a = acceleration.plain(n), moved = row(nodes.position, n) - row(nodes.reference, n);
    const Vector3 v = row(nodes.velocity, n) + (acceleration.levels.steps(n) * lag) * acceleration(n);
    for (int i = 0; i < 3; ++i) {
      sum[i] += w * moved[i];
      sum[3 + i] += w * v[i];
      sum[6 + i] += w * a[i];
    }
  }
};

/// Stored in connectors' springs, and dissipated in their dashpots.
struct ConnectorEnergy {
  static constexpr int values = 2;
  Array<const double* [2]> energy;
  KOKKOS_INLINE_FUNCTION void operator()(int c, double* sum) const {
    for (int k = 0; k < values; ++k) sum[k] += energy(c, k);
  }
};

/// Shares a group's energies, fetched, out among its parts: a block lies in one.
void share_out(const std::vector<Assembly::PartRange>& parts, const ElementGroup& group,
               std::vector<PartEnergy>& by_part) {
  const auto& energy = group.block_energy_fetched;
  std::size_t p = 0;
  for (int block = 0; block < group.blocks.count; ++block) {
    const auto holds = [&](std::size_t part) {
      const int within = group.first_element[block] - parts[part].first_element;
      return within >= 0 && within < parts[part].element_count;
    };
    if (!holds(p))
      for (p = 0; p + 1 < parts.size() && !holds(p);) ++p;
    by_part[p].internal += energy(block, 0);
    by_part[p].hourglass += energy(block, 1);
  }
}

/// Calls `work` with the work of flow of a group's elements, where they flow.
template <class S, class Work>
void with_flow_work(const ElementGroup& group, const Work& work) {
  with_material(group, [&](const auto& material) {
    using Material = std::decay_t<decltype(material)>;
    if constexpr (Material::history_values > 0)
      work(FlowWork<S, Material>{material, group.blocks.material, group.material.volume});
  });
}

template <class S, class Hourglass>
void queue_element_energy(const NodeArrays& nodes, const ElementGroup& group, EnergyAccount& energy, bool by_part,
                          Reductions& sums) {
  const int count = group.blocks.count;
  with_material(group, [&](const auto& material) {
    using State = ElementState<S, std::decay_t<decltype(material)>, Hourglass>;
    launch_blocks(group.blocks,
                  State{material, group.blocks, group.blocks.hourglass_scale, nodes, {}, group.block_energy});
  });
  sums.sum(BlockEnergy{group.block_energy, group.blocks.hourglass_energy}, count, [&energy](const double* sum) {
    energy.internal += sum[0];
    energy.hourglass += sum[1];
  });
  if (by_part) {
    Kokkos::parallel_for("add_dissipated", Range(0, count),
                         AddDissipated{group.block_energy, group.blocks.hourglass_energy, power_sums});
    with_flow_work<S>(group, [&](const auto& flow_work) {
      Kokkos::parallel_for("add_flow_work", Range(0, count),
                           AddFlowWork<std::decay_t<decltype(flow_work)>>{flow_work, group.block_energy});
    });
    Kokkos::deep_copy(ExecutionSpace(), group.block_energy_fetched, group.block_energy);
  }
  if (group.damping.active())
    sums.sum(ArraySum{group.damping.energy}, count, [&energy](const double* sum) { energy.damping += *sum; });
  with_flow_work<S>(group, [&](const auto& flow_work) {
    sums.sum(flow_work, count * elements_of_block, [&energy](const double* sum) { energy.plastic += *sum; });
  });
}

template <class S>
void queue_element_energies(const std::vector<ElementGroup>& groups, const NodeArrays& nodes, EnergyAccount& energy,
                            bool by_part, Reductions& sums) {
  for (const ElementGroup& group : groups) {
    if (group.hourglass == scene::HourglassType::viscous)
      queue_element_energy<S, ViscousHourglass>(nodes, group, energy, by_part, sums);
    else
      queue_element_energy<S, StiffnessHourglass>(nodes, group, energy, by_part, sums);
  }
}

void queue_contact_energies(const std::vector<ContactPair>& contacts, EnergyAccount& energy, Reductions& sums) {
  for (const ContactPair& pair : contacts) {
    const int count = pair.arrays.slave_count;
    const auto add = [&energy](const double* sum) {
      energy.contact += sum[0];
      energy.friction += sum[1];
    };
    if (pair.has_springs()) {
      with_contact_law(*pair.contact, pair.law, false, [&](const auto& law) {
        sums.sum(ContactEnergy<std::decay_t<decltype(law)>>{pair.arrays, law, pair.law.state}, count,
                 [&energy, add](const double* sum) {
                   add(sum);
                   energy.damping += sum[2];
                 });
      });
    } else {
      sums.sum(MultiplierEnergy{pair.multipliers.impact_energy, pair.arrays.friction_energy}, count,
               [&energy, add](const double* sum) {
                 add(sum);
                 energy.impacts += sum[0];
               });
    }
  }
}

/// Everything that account_energies() gives, into `energy`, when the sums are fetched. Parts get theirs by share_out().
void queue_energies(const Model& model, double step, EnergyAccount& energy, bool by_part, Reductions& sums) {
  const auto external = [&energy](const double* sum) { energy.external_work += *sum; };
  sums.sum(NodalEnergy{model.subcycled_acceleration(), model.velocity_lag, step}, model.nodes.count,
           [&energy](const double* sum) {
             energy.kinetic += sum[0];
             energy.external_work += sum[1];
           });
  with_element_precision(model, [&](auto number) {
    queue_element_energies<decltype(number)>(model.elements, model.nodes, energy, by_part, sums);
  });
  queue_contact_energies(model.contacts, energy, sums);
  if (!model.loads.empty()) sums.sum(ArraySum{model.external.work}, model.external.contribution_count, external);
  for (const PrescribedSet& set : model.prescribed)
    sums.sum(PrescribedWork{prescribed_motion(model, set, 0)}, static_cast<int>(set.nodes.extent(0)), external);
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

/// A part's share of the groups' energies, when the sums have been fetched.
void share_out_all(const Assembly& assembly, const std::vector<ElementGroup>& groups,
                   std::vector<PartEnergy>& by_part) {
  by_part.assign(assembly.parts.size(), {});
  for (const ElementGroup& group : groups) share_out(assembly.parts, group, by_part);
}

}  // namespace

EnergyAccount account_energies(const Model& model, double step) {
  EnergyAccount energy;
  Reductions sums(*model.reduction_space);
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

void queue_pair_totals(const NodalState& nodal, const ContactPair& pair, ContactTotals& totals, Reductions& sums) {
  sums.sum(SlaveSums{pair.arrays}, pair.arrays.slave_count, [&totals](const double* sum) {
    for (int i = 0; i < 3; ++i) {
      totals.normal_force[i] = sum[i];
      totals.tangential_force[i] = sum[3 + i];
      totals.master_force[i] = sum[6 + i];
    }
    totals.nodes_in_contact = static_cast<int>(sum[9]);
    totals.nodes_slipping = static_cast<int>(sum[10]);
  });
  if (!pair.own_master) return;
  sums.sum(MasterSums{nodal.external.sum, nodal.nodes.external_row, pair.arrays.master_nodes}, pair.arrays.master_count,
           [&totals](const double* sum) {
             for (int i = 0; i < 3; ++i) totals.master_force[i] = sum[i];
           });
}

/// The other half of a symmetric contact has the surfaces exchanged.
void add_other_half(ContactTotals& totals, const ContactTotals& other) {
  for (int i = 0; i < 3; ++i) {
    const double slave = totals.normal_force[i] + totals.tangential_force[i];
    totals.normal_force[i] -= other.normal_force[i];
    totals.tangential_force[i] -= other.tangential_force[i];
    totals.master_force[i] += slave - (totals.normal_force[i] + totals.tangential_force[i]);
  }
}

}  // namespace

ContactTotals contact_totals(const NodalState& nodal, const std::vector<ContactPair>& contacts, std::size_t number) {
  const ContactPair& pair = contacts[number];
  ContactTotals totals, other;
  Reductions sums(*nodal.reduction_space);
  queue_pair_totals(nodal, pair, totals, sums);
  if (pair.partner >= 0) queue_pair_totals(nodal, contacts[pair.partner], other, sums);
  sums.fetch();
  if (pair.partner >= 0) add_other_half(totals, other);
  return totals;
}

namespace {

/// On the host, for tied nodes move as their masters do.
MeanMotion mean_motion_with_ties(const NodalState& nodal, const Ties& ties, const LoadModel& loads, int set) {
  const int begin = loads.first_of_set[set], end = loads.first_of_set[set + 1];
  const auto all = to_host(loads.sets.nodes);
  const auto weight = to_host(loads.sets.weight);
  const std::vector<int> nodes(all.data() + begin, all.data() + end);
  MeanMotion mean;
  for (auto [field, sum] : {std::pair{NodeField::displacement, &mean.displacement},
                            {NodeField::velocity, &mean.velocity},
                            {NodeField::acceleration, &mean.acceleration}}) {
    const auto values = node_field(nodal, ties, field, nodes).values;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int i = 0; i < 3; ++i) (*sum)[i] += weight(begin + static_cast<int>(k)) * values[3 * k + i];
  }
  return mean;
}

void queue_mean_motion(const NodalState& nodal, const LoadModel& loads, int set, MeanMotion& mean, Reductions& sums) {
  const int begin = loads.first_of_set[set], end = loads.first_of_set[set + 1];
  sums.sum(MeanMotionSum{nodal.subcycled_acceleration(), loads.sets, begin, nodal.velocity_lag}, end - begin,
           [&mean](const double* sum) {
             for (int i = 0; i < 3; ++i) {
               mean.displacement[i] = sum[i];
               mean.velocity[i] = sum[3 + i];
               mean.acceleration[i] = sum[6 + i];
             }
           });
}

}  // namespace

HistorySample sample_for_monitor(const Model& model, double step, std::vector<PartEnergy>* by_part) {
  HistorySample sample;
  sample.time = model.time;
  sample.step = model.step;
  std::vector<ContactTotals> pairs(model.contacts.size());
  Reductions sums(*model.reduction_space);
  queue_energies(model, step, sample.energy, by_part != nullptr, sums);
  for (std::size_t c = 0; c < pairs.size(); ++c) queue_pair_totals(model, model.contacts[c], pairs[c], sums);
  sums.fetch();
  if (by_part != nullptr) share_out_all(model.assembly, model.elements, *by_part);
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const ContactPair& pair = model.contacts[c];
    if (pair.reversed) continue;
    if (pair.partner >= 0) add_other_half(pairs[c], pairs[pair.partner]);
    sample.contacts.push_back(pairs[c]);
  }
  return sample;
}

void add_history_values(const Model& model, HistorySample& sample) {
  const bool tied = model.ties.arrays.active();
  sample.sets.resize(model.history_sets.size());
  Reductions sums(*model.reduction_space);
  for (std::size_t s = 0; s < sample.sets.size(); ++s) {
    if (tied)
      sample.sets[s] = mean_motion_with_ties(model, model.ties, model, model.history_sets[s]);
    else
      queue_mean_motion(model, model, model.history_sets[s], sample.sets[s], sums);
  }
  queue_element_means(model, model.nodes, sample.elements, sums);
  queue_load_totals(model, model.loads, sample.loads, sums);
  sums.fetch();
  if (model.beams) sample.beams = beam_resultants(*model.beams, model.nodes);
}

HistorySample take_sample(const Model& model, double step, std::vector<PartEnergy>* by_part) {
  HistorySample sample = sample_for_monitor(model, step, by_part);
  add_history_values(model, sample);
  return sample;
}

}  // namespace railwave
