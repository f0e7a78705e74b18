#pragma once

#include "kernels/connector.hpp"
#include "kernels/extra_force.hpp"
#include "kernels/torque.hpp"

namespace railwave {

/// The loads on one row: gathers its contributions, after giving those of torques and connectors their values.
struct RowLoads {
  ExtraForces extra;
  ConnectorArrays connectors;
  TorqueArrays torques;
  Array<const double* [3]> position, velocity;
  double elapsed;  ///< s since the last step

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const LoadedRow loaded = extra.loaded(i);
    Vector3 sum{{0, 0, 0}};
    for (int k = loaded.first; k < loaded.last; ++k) sum = sum + value(extra.shares(k), loaded.node);
    for (int c = 0; c < 3; ++c) extra.sum.load(loaded.row, c) = sum[c];
  }

  KOKKOS_INLINE_FUNCTION Vector3 value(const RowShare& share, int node) const {
    if (share.law == RowShare::given) return row(extra.contribution, share.contribution);
    if (share.law < connectors.count) return share.weight * row(connectors.force, share.law);
    const int t = share.law - connectors.count;
    const Vector3 arm = row(position, node) - Vector3{{torques.now(t, 0), torques.now(t, 1), torques.now(t, 2)}};
    const Vector3 force = (share.weight * torques.now(t, 3)) * cross(row(torques.axis, t), arm);
    set_contribution(extra, velocity, share.contribution, force, elapsed);
    return force;
  }
};

/// All that follows from the mean motion of node sets, in one team: sums over the sets, connector forces and torques, and
/// unless they are too many for a team the rows that feel them.
struct SetLoads {
  SetMotion sets;
  ConnectorForce connectors;
  TorqueNow torques;
  RowLoads rows;
  int row_count;  ///< rows to do here, all or none

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int rank = team.team_rank(), size = team.team_size();
    for (int c = rank; c < static_cast<int>(sets.sets.chunks.extent(0)); c += size) sets.sum_chunk(c);
    team.team_barrier();
    for (int k = rank; k < sets.sets.moving * NodeSets::values; k += size) sets.add_chunks(k);
    team.team_barrier();
    const int laws = connectors.connectors.count + torques.torques.count;
    for (int k = rank; k < laws; k += size) {
      if (k < connectors.connectors.count) connectors(k);
      else torques(k - connectors.connectors.count);
    }
    team.team_barrier();
    for (int k = rank; k < row_count; k += size) rows(k);
  }
};

}  // namespace railwave
