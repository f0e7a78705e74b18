#pragma once

#include "kernels/loads/torque.hpp"
#include "kernels/nodes/external_force.hpp"
#include "kernels/support/batches.hpp"

namespace railwave {

/// The loads on one row: gathers its contributions, after giving those of torques and connectors their values.
struct RowLoads {
  static constexpr int shares_ahead = 2;

  /// A row with what can be asked of memory before its loads are known.
  struct Ahead {
    LoadedRow loaded{};
    RowShare share[shares_ahead] = {};
  };

  ExternalForces external;
  int connectors;                            ///< so many
  Array<const double* [3]> connector_force;  ///< N, on `to`
  TorqueArrays torques;
  Array<const double*[3]> position, velocity;
  double elapsed;  ///< s since the last step

  /// @tparam batch few where a kernel does much else: batches take registers
  /// @return the sum, N
  template <int batch>
  KOKKOS_INLINE_FUNCTION Vector3 gather(const LoadedRow& loaded) const {
    return with_rest<batch>({{0, 0, 0}}, loaded, loaded.first);
  }

  KOKKOS_INLINE_FUNCTION Ahead ask_ahead(const LoadedRow& loaded) const {
    Ahead ahead;
    ahead.loaded = loaded;
    for (int j = 0; j < shares_ahead; ++j)
      if (loaded.first + j < loaded.last) ahead.share[j] = external.shares(loaded.first + j);
    return ahead;
  }

  /// The same.
  template <int batch>
  KOKKOS_INLINE_FUNCTION Vector3 gather(const Ahead& ahead) const {
    const LoadedRow& loaded = ahead.loaded;
    Vector3 sum{{0, 0, 0}};
    for (int j = 0; j < shares_ahead; ++j)
      if (loaded.first + j < loaded.last) sum = added(without_torque(ahead.share[j]), sum);
    return with_rest<batch>(sum, loaded, loaded.first + shares_ahead);
  }

  /// The same by a team, for a row with many contributions, none of them a torque's: it asks for these at once.
  /// @param part scratch for WeightedVector, parts_at_once
  template <class Member>
  KOKKOS_INLINE_FUNCTION void gather_together(const Member& team, const LoadedRow& loaded, WeightedVector* part) const {
    const int rank = team.team_rank(), size = team.team_size();
    double sum[3] = {};
    for (int first = loaded.first; first < loaded.last; first += parts_at_once) {
      const int count = first + parts_at_once < loaded.last ? parts_at_once : loaded.last - first;
      for (int k = rank; k < count; k += size) part[k] = without_torque(external.shares(first + k));
      team.team_barrier();
      for (int c = 0; c < 3; ++c)
        if (c % size == rank)
          for (int k = 0; k < count; ++k) sum[c] = multiply_add(part[k].weight, part[k].vector[c], sum[c]);
      team.team_barrier();
    }
    for (int c = 0; c < 3; ++c)
      if (c % size == rank) external.sum.load(loaded.row, c) = sum[c];
  }
  static constexpr int parts_at_once = 32;

  /// @param first of the contributions that are not in `sum` yet
  template <int batch>
  KOKKOS_INLINE_FUNCTION Vector3 with_rest(Vector3 sum, const LoadedRow& loaded, int first) const {
    sum = add_in_batches<batch>(sum, first, loaded.last, [&](int k) { return without_torque(external.shares(k)); });
    if (torques.count > 0) sum = sum + torque_forces(loaded);
    for (int c = 0; c < 3; ++c) external.sum.load(loaded.row, c) = sum[c];
    return sum;
  }

  /// What a load's own kernel has put in place, or a connector's force; nothing of torques.
  KOKKOS_INLINE_FUNCTION WeightedVector without_torque(const RowShare& share) const {
    const bool torque = share.law >= connectors, connector = share.law >= 0 && !torque;
    const Array<const double* [3]>& given = external.contribution;
    return {torque ? 0.0 : share.weight,
            row(connector ? connector_force : given, connector ? share.law : share.contribution)};
  }

  /// Gives the contributions of torques their values.
  KOKKOS_INLINE_FUNCTION Vector3 torque_forces(const LoadedRow& loaded) const {
    Vector3 sum{{0, 0, 0}};
    for (int k = loaded.first; k < loaded.last; ++k) {
      const RowShare share = external.shares(k);
      if (share.law < connectors) continue;
      const int t = share.law - connectors;
      const Vector3 arm =
          row(position, loaded.node) - Vector3{{torques.now(t, 0), torques.now(t, 1), torques.now(t, 2)}};
      const Vector3 force = (share.weight * torques.now(t, 3)) * cross(row(torques.axis, t), arm);
      set_contribution(external, velocity, share.contribution, loaded.node, force, elapsed);
      sum = sum + force;
    }
    return sum;
  }
};

/// The rows of a list by teams: first those with few contributions, some of them for a team, then one row for each.
struct ListedRowLoads {
  static constexpr int rows_of_team = 32, few = 8;

  RowLoads rows;
  Array<const LoadedRow*> listed;
  int with_few;

  KOKKOS_INLINE_FUNCTION static int teams_of(int rows) { return (rows + rows_of_team - 1) / rows_of_team; }
  int teams() const { return teams_of(with_few) + static_cast<int>(listed.extent(0)) - with_few; }
  static std::size_t scratch_size() { return RowLoads::parts_at_once * sizeof(WeightedVector) + scratch_alignment; }

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int t = team.league_rank(), of_few = teams_of(with_few);
    if (t >= of_few)
      return rows.gather_together(team, listed(with_few + t - of_few),
                                  scratch_values<WeightedVector>(team, RowLoads::parts_at_once));
    const int end = (t + 1) * rows_of_team < with_few ? (t + 1) * rows_of_team : with_few;
    for (int i = t * rows_of_team + team.team_rank(); i < end; i += team.team_size())
      rows.gather<batch_of_few_threads>(listed(i));
  }
};

}  // namespace railwave
