#include "solve/account.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/block_sum.hpp"
#include "kernels/watch_terms.hpp"
#include "model/element_precision.hpp"
#include "model/fields.hpp"
#include "model/host_copy.hpp"
#include "model/group_material.hpp"
#include "model/patch_launch.hpp"
#include "model/prescribed_motion.hpp"
#include "solve/beams.hpp"
#include "solve/load_totals.hpp"

namespace railwave {
namespace {

/// Kinetic energy at t_n, m v(n-1/2).v(n+1/2)/2 = m (|v_n|^2 - |step a/2|^2)/2, and minus the work of gravity.
struct NodalEnergy {
  static constexpr int values = 2;
  PacedAcceleration acceleration;
  double lag, step;

  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const double pace = acceleration.paces.pace(n);
    const Vector3 a = pace * acceleration(n);
    const Vector3 v = row(nodes.velocity, n) + lag * a;
    sum[0] += 0.5 * nodes.mass(n) * (dot(v, v) - 0.25 * step * step * dot(a, a));
    sum[1] += nodes.mass(n) * dot(acceleration.plain.gravity, row(nodes.position, n) - row(nodes.reference, n));
  }
};

/// Elastic energy of the patches, and what their hourglass control has stored or dissipated.
struct PatchEnergy {
  static constexpr int values = 2;
  Array<const double* [2]> energy;
  Array<const double*> dissipated;
  KOKKOS_INLINE_FUNCTION void operator()(int p, double* sum) const {
    sum[0] += energy(p, 0);
    sum[1] += energy(p, 1);
    for (int k = 0; k < power_sums; ++k) sum[1] += dissipated(p * power_sums + k);
  }
};

/// Work of plastic flow: a function of the equivalent plastic strain and the back stress.
template <class S>
struct PlasticEnergy {
  static constexpr int values = 1;
  PatchArrays patches;
  PlasticArrays plastic;
  KOKKOS_INLINE_FUNCTION void operator()(int slot, double* sum) const {
    const BilinearConstants constants = plastic.constants(patches.material(slot / patch_size));
    const double equivalent = plastic.history(tiled_slot<S>(slot, Bilinear::history_values, 6));
    if (plastic.back_stress.extent(0) == 0) {
      sum[0] += plastic.volume(slot) * plastic_work(constants, equivalent);
      return;
    }
    double back[KinematicBilinear::back_values];
    for (int c = 0; c < KinematicBilinear::back_values; ++c)
      back[c] = plastic.back_stress(tiled_slot<S>(slot, KinematicBilinear::back_values, c));
    sum[0] += plastic.volume(slot) *
              plastic_work(constants, plastic.isotropic_share(patches.material(slot / patch_size)), equivalent, back);
  }
};

/// Adds the work of plastic flow of a patch's slots to what the patch has stored.
template <class S>
struct AddPlastic {
  PlasticEnergy<S> of_slot;
  Array<double* [2]> energy;
  KOKKOS_INLINE_FUNCTION void operator()(const int p) const {
    double sum = 0;
    for (int slot = p * patch_size; slot < (p + 1) * patch_size; ++slot) of_slot(slot, &sum);
    energy(p, 0) += sum;
  }
};

/// Stored in the penalty springs; dissipated by friction, and by the springs' damping.
struct ContactEnergy {
  static constexpr int values = 3;
  ContactArrays contact;
  ContactLawArrays law;
  KOKKOS_INLINE_FUNCTION void operator()(int s, double* sum) const {
    sum[1] += contact.friction_energy(s);
    if (law.damping > 0) sum[2] += law.damping_energy(s);
    if (contact.status(s) == status_apart) return;
    const double stiffness = contact.segment_stiffness(contact.tracked(s));
    const Vector3 n = row(contact.normal_force, s), t = row(contact.tangential_force, s);
    if (law.active) sum[0] += stiffness * law.growth.at(-contact.gap(s)).energy + 0.5 * dot(t, t) / stiffness;
    else sum[0] += 0.5 * (dot(n, n) + dot(t, t)) / stiffness;
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

/// Sums over the slave's nodes: normal force, tangential force, what the shape functions pass on to the master; nodes in
/// contact, nodes that slip.
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
  ExtraForceSum extra;
  Array<const int*> extra_row, nodes;
  KOKKOS_INLINE_FUNCTION void operator()(int m, double* sum) const {
    const Vector3 force = extra.contact_force(extra_row(nodes(m)));
    for (int i = 0; i < 3; ++i) sum[i] += force[i];
  }
};

/// Weighted displacement, velocity and acceleration at t_n of a set's nodes.
struct MeanMotionSum {
  static constexpr int values = 9;
  PacedAcceleration acceleration;
  NodeSets sets;
  int begin;
  double lag;
  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const int n = sets.nodes(begin + k);
    const double w = sets.weight(begin + k);
    const Vector3 a = acceleration.plain(n), moved = row(nodes.position, n) - row(nodes.reference, n);
    const Vector3 v = row(nodes.velocity, n) + (acceleration.paces.pace(n) * lag) * acceleration(n);
    for (int i = 0; i < 3; ++i) {
      sum[i] += w * moved[i];
      sum[3 + i] += w * v[i];
      sum[6 + i] += w * a[i];
    }
  }
};

struct Work {
  static constexpr int values = 1;
  Array<const double*> work;
  KOKKOS_INLINE_FUNCTION void operator()(int c, double* sum) const { sum[0] += work(c); }
};

/// Shares a group's energies out among its parts: a patch lies in one.
template <class S>
void share_out(const Model& model, const ElementGroup& group, const Array<double* [2]>& patch_energy, std::vector<PartEnergy>& by_part) {
  Kokkos::parallel_for("add_dissipated", Range(0, group.patches.count), AddDissipated{patch_energy, group.patches.hourglass_energy, power_sums});
  if (group.plastic.active())
    Kokkos::parallel_for("add_plastic", Range(0, group.patches.count), AddPlastic<S>{{group.patches, group.plastic}, patch_energy});
  const auto energy = to_host(patch_energy);
  const auto& parts = model.assembly.parts;
  std::size_t p = 0;
  for (int patch = 0; patch < group.patches.count; ++patch) {
    const auto holds = [&](std::size_t part) {
      const int within = group.first_element[patch] - parts[part].first_element;
      return within >= 0 && within < parts[part].element_count;
    };
    if (!holds(p))
      for (p = 0; p + 1 < parts.size() && !holds(p);) ++p;
    by_part[p].internal += energy(patch, 0);
    by_part[p].hourglass += energy(patch, 1);
  }
}

template <class S, class Hourglass>
void element_energy(const Model& model, const ElementGroup& group, EnergyAccount& energy, std::vector<PartEnergy>* by_part) {
  const auto patch_energy = unset_array<double* [2]>("patch energy", group.patches.count);
  with_material(group, [&](const auto& material) {
    using State = PatchState<S, std::decay_t<decltype(material)>, Hourglass>;
    launch_patches(group.patches, State{material, group.patches, group.patches.hourglass_scale, model.nodes, {}, patch_energy});
  });
  double sum[2];
  block_sum(PatchEnergy{patch_energy, group.patches.hourglass_energy}, group.patches.count, sum, model.sum_space);
  energy.internal += sum[0];
  energy.hourglass += sum[1];
  if (by_part != nullptr) share_out<S>(model, group, patch_energy, *by_part);
  if (group.damping.active()) {
    block_sum(Work{group.damping.energy}, group.patches.count, sum, model.sum_space);
    energy.damping += sum[0];
  }
  if (!group.plastic.active()) return;
  block_sum(PlasticEnergy<S>{group.patches, group.plastic}, group.patches.count * patch_size, sum);
  energy.plastic += sum[0];
}

template <class S>
void element_energies(const Model& model, EnergyAccount& energy, std::vector<PartEnergy>* by_part) {
  if (by_part != nullptr) by_part->assign(model.assembly.parts.size(), {});
  for (const ElementGroup& group : model.elements) {
    if (group.hourglass == scene::HourglassType::viscous) element_energy<S, ViscousHourglass>(model, group, energy, by_part);
    else element_energy<S, StiffnessHourglass>(model, group, energy, by_part);
  }
}

}  // namespace

EnergyAccount account_energies(const Model& model, double step, std::vector<PartEnergy>* by_part) {
  EnergyAccount energy;
  double sum[3];
  block_sum(NodalEnergy{model.paced_acceleration(), model.velocity_lag, step}, model.nodes.count, sum, model.sum_space);
  energy.kinetic = sum[0];
  energy.external_work = sum[1];
  with_element_precision(model.scene, [&](auto number) { element_energies<decltype(number)>(model, energy, by_part); });
  for (const ContactPair& pair : model.contacts) {
    sum[2] = 0;
    if (pair.has_springs()) block_sum(ContactEnergy{pair.arrays, pair.law}, pair.arrays.slave_count, sum, model.sum_space);
    else block_sum(MultiplierEnergy{pair.multipliers.impact_energy, pair.arrays.friction_energy}, pair.arrays.slave_count, sum, model.sum_space);
    energy.contact += sum[0];
    energy.friction += sum[1];
    energy.damping += sum[2];
  }
  if (!model.loads.empty()) {
    block_sum(Work{model.extra.work}, model.extra.contribution_count, sum, model.sum_space);
    energy.external_work += sum[0];
  }
  for (const PrescribedSet& set : model.prescribed) {
    block_sum(PrescribedWork{prescribed_motion(model, set, 0)}, static_cast<int>(set.nodes.extent(0)), sum, model.sum_space);
    energy.external_work += sum[0];
  }
  if (model.ends.arrays.count > 0) {
    block_sum(NonReflectingEnergy{model.ends.arrays, model.nodes.position}, model.ends.arrays.count, sum, model.sum_space);
    energy.damping += sum[0];
    energy.external_work += sum[1];
  }
  if (model.beams) add_beam_energies(model, step, energy);
  const auto connectors = to_host(model.connectors.arrays.energy);
  for (int c = 0; c < model.connectors.arrays.count; ++c) {
    energy.connector += connectors(c, 0);
    energy.damping += connectors(c, 1);
  }
  return energy;
}

double balance_total(const EnergyAccount& energy) {
  return energy.kinetic + energy.internal + energy.hourglass + energy.contact + energy.friction + energy.connector +
         energy.damping + energy.plastic - energy.external_work;
}

double largest_energy(const EnergyAccount& energy) {
  return std::max({std::fabs(energy.kinetic), std::fabs(energy.internal), std::fabs(energy.hourglass),
                   std::fabs(energy.contact), std::fabs(energy.friction), std::fabs(energy.connector),
                   std::fabs(energy.damping), std::fabs(energy.plastic), std::fabs(energy.external_work)});
}

namespace {

ContactTotals pair_totals(const Model& model, const ContactPair& pair) {
  double slave[11], master[3];
  block_sum(SlaveSums{pair.arrays}, pair.arrays.slave_count, slave, model.sum_space);
  block_sum(MasterSums{model.extra.sum, model.nodes.extra, pair.arrays.master_nodes}, pair.arrays.master_count, master,
            model.sum_space);
  ContactTotals totals;
  for (int i = 0; i < 3; ++i) {
    totals.normal_force[i] = slave[i];
    totals.tangential_force[i] = slave[3 + i];
    totals.master_force[i] = pair.own_master ? master[i] : slave[6 + i];
  }
  totals.nodes_in_contact = static_cast<int>(slave[9]);
  totals.nodes_slipping = static_cast<int>(slave[10]);
  return totals;
}

}  // namespace

ContactTotals contact_totals(const Model& model, const ContactPair& pair) {
  ContactTotals totals = pair_totals(model, pair);
  if (pair.partner < 0) return totals;
  // The other half of a symmetric contact has the surfaces exchanged.
  const ContactTotals other = pair_totals(model, model.contacts[pair.partner]);
  for (int i = 0; i < 3; ++i) {
    const double slave = totals.normal_force[i] + totals.tangential_force[i];
    totals.normal_force[i] -= other.normal_force[i];
    totals.tangential_force[i] -= other.tangential_force[i];
    totals.master_force[i] += slave - (totals.normal_force[i] + totals.tangential_force[i]);
  }
  return totals;
}

namespace {

/// On the host, for tied nodes move as their masters do.
MeanMotion mean_motion_with_ties(const Model& model, int begin, int end) {
  const auto all = to_host(model.sets.nodes);
  const auto weight = to_host(model.sets.weight);
  const std::vector<int> nodes(all.data() + begin, all.data() + end);
  MeanMotion mean;
  for (auto [field, sum] : {std::pair{NodeField::displacement, &mean.displacement}, {NodeField::velocity, &mean.velocity},
                            {NodeField::acceleration, &mean.acceleration}}) {
    const auto values = node_field(model, field, nodes).values;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int i = 0; i < 3; ++i) (*sum)[i] += weight(begin + static_cast<int>(k)) * values[3 * k + i];
  }
  return mean;
}

}  // namespace

MeanMotion mean_motion(const Model& model, int set) {
  const int begin = model.first_of_set[set], end = model.first_of_set[set + 1];
  if (model.ties.arrays.active()) return mean_motion_with_ties(model, begin, end);
  double sum[9];
  block_sum(MeanMotionSum{model.paced_acceleration(), model.sets, begin, model.velocity_lag}, end - begin, sum,
            model.sum_space);
  MeanMotion mean;
  for (int i = 0; i < 3; ++i) {
    mean.displacement[i] = sum[i];
    mean.velocity[i] = sum[3 + i];
    mean.acceleration[i] = sum[6 + i];
  }
  return mean;
}

HistorySample take_sample(const Model& model, double step, std::vector<PartEnergy>* by_part) {
  HistorySample sample;
  sample.time = model.time;
  sample.step = model.step;
  sample.energy = account_energies(model, step, by_part);
  for (const ContactPair& pair : model.contacts)
    if (!pair.reversed) sample.contacts.push_back(contact_totals(model, pair));
  for (int set : model.history_sets) sample.sets.push_back(mean_motion(model, set));
  if (model.beams) sample.beams = beam_resultants(model);
  sample.loads = load_totals(model);
  return sample;
}

}  // namespace railwave
