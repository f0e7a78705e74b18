#pragma once

#include "kernels/loads/connector.hpp"
#include "kernels/loads/torque.hpp"
#include "kernels/nodes/external_force.hpp"
#include "kernels/support/batches.hpp"

namespace railwave {

/// The loads on one row: gathers its contributions, after giving those of torques and connectors their values.
struct RowLoads {
  ExternalForces external;
  ConnectorArrays connectors;
  TorqueArrays torques;
  Array<const double*[3]> position, velocity;
  double elapsed;  ///< s since the last step

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { gather<batch_of_few_threads>(external.loaded(i)); }

  /// @tparam batch few where a kernel does much else: batches take registers
  /// @return the sum, N
  template <int batch>
  KOKKOS_INLINE_FUNCTION Vector3 gather(const LoadedRow& loaded) const {
    Vector3 sum = add_in_batches<batch>({{0, 0, 0}}, loaded.first, loaded.last,
                                        [&](int k) { return without_torque(external.shares(k)); });
    if (torques.count > 0) sum = sum + torque_forces(loaded);
    for (int c = 0; c < 3; ++c) external.sum.load(loaded.row, c) = sum[c];
    return sum;
  }

  /// What a load's own kernel has put in place, or a connector's force; nothing of torques.
  KOKKOS_INLINE_FUNCTION WeightedVector without_torque(const RowShare& share) const {
    const bool torque = share.law >= connectors.count, connector = share.law >= 0 && !torque;
    const auto& from = connector ? connectors.force : external.contribution;
    return {torque ? 0.0 : share.weight, row(from, connector ? share.law : share.contribution)};
  }

  /// Gives the contributions of torques their values.
  KOKKOS_INLINE_FUNCTION Vector3 torque_forces(const LoadedRow& loaded) const {
    Vector3 sum{{0, 0, 0}};
    for (int k = loaded.first; k < loaded.last; ++k) {
      const RowShare share = external.shares(k);
      if (share.law < connectors.count) continue;
      const int t = share.law - connectors.count;
      const Vector3 arm =
          row(position, loaded.node) - Vector3{{torques.now(t, 0), torques.now(t, 1), torques.now(t, 2)}};
      const Vector3 force = (share.weight * torques.now(t, 3)) * cross(row(torques.axis, t), arm);
      set_contribution(external, velocity, share.contribution, loaded.node, force, elapsed);
      sum = sum + force;
    }
    return sum;
  }
};

/// All that follows from the mean motion of node sets, in one team: sums over the sets, connector forces and torques,
/// and unless they are too many for a team the rows that feel them.
struct SetLoads {
  SetMotion sets;
  ConnectorForce connectors;
  TorqueNow torques;
  RowLoads rows;
  int row_count;  ///< rows to do here, all or none

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int rank = team.team_rank(), size = team.team_size();
    for (int c = rank; c < chunk_count(); c += size) sets.sum_chunk(c);
    team.team_barrier();
    for (int k = rank; k < sum_count(); k += size) sets.add_chunks(k);
    team.team_barrier();
    for (int k = rank; k < law_count(); k += size) law(k);
    team.team_barrier();
    for (int k = rank; k < row_count; k += size) rows.template gather<1>(rows.external.loaded(k));
  }

  KOKKOS_INLINE_FUNCTION int chunk_count() const { return static_cast<int>(sets.sets.chunks.extent(0)); }
  KOKKOS_INLINE_FUNCTION int sum_count() const { return sets.sets.moving * NodeSets::values; }
  KOKKOS_INLINE_FUNCTION int law_count() const { return connectors.connectors.count + torques.torques.count; }
  KOKKOS_INLINE_FUNCTION void law(int k) const {
    if (k < connectors.connectors.count)
      connectors(k);
    else
      torques(k - connectors.connectors.count);
  }
};

/// The same work but for the rows, where the sets are too many for a team: a launch for each phase, whose threads lie
/// all over a device.
struct SetChunkSums {
  SetMotion sets;
  KOKKOS_INLINE_FUNCTION void operator()(const int c) const { sets.sum_chunk(c); }
};
struct SetSums {
  SetMotion sets;
  KOKKOS_INLINE_FUNCTION void operator()(const int k) const { sets.add_chunks(k); }
};
struct SetLaws {
  SetLoads all;
  KOKKOS_INLINE_FUNCTION void operator()(const int k) const { all.law(k); }
};

}  // namespace railwave
