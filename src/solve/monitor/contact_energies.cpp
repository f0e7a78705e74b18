#include "kernels/support/vector3.hpp"
#include "model/contact/contact_law.hpp"
#include "solve/monitor/account.hpp"
#include "solve/monitor/energies.hpp"

namespace railwave {
namespace {

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

}  // namespace

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

void add_other_half(ContactTotals& totals, const ContactTotals& other) {
  for (int i = 0; i < 3; ++i) {
    const double slave = totals.normal_force[i] + totals.tangential_force[i];
    totals.normal_force[i] -= other.normal_force[i];
    totals.tangential_force[i] -= other.tangential_force[i];
    totals.master_force[i] += slave - (totals.normal_force[i] + totals.tangential_force[i]);
  }
}

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

}  // namespace railwave
