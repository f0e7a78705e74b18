#pragma once

#include "kernels/contact/contact_arrays.hpp"
#include "kernels/contact/contact_projection.hpp"
#include "kernels/contact/law_at_nodes.hpp"
#include "kernels/nodes/external_force_sum.hpp"
#include "kernels/support/vector3.hpp"

/// What a sample sums over the nodes of contacts.
namespace railwave {

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

}  // namespace railwave
