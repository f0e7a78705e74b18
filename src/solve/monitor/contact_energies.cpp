#include "kernels/contact/contact_sums.hpp"
#include "model/contact/contact_law.hpp"
#include "solve/monitor/account.hpp"
#include "solve/monitor/energies.hpp"

namespace railwave {
void queue_contact_energies(const std::vector<ContactPair>& contacts, EnergyAccount& energy, SampleSums& sums) {
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

void queue_pair_totals(const NodalState& nodal, const ContactPair& pair, ContactTotals& totals, SampleSums& sums) {
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
  SampleSums sums(*nodal.reduction_space);
  queue_pair_totals(nodal, pair, totals, sums);
  if (pair.partner >= 0) queue_pair_totals(nodal, contacts[pair.partner], other, sums);
  sums.fetch();
  if (pair.partner >= 0) add_other_half(totals, other);
  return totals;
}

}  // namespace railwave
