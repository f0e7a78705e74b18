#pragma once

#include "kernels/nodes.hpp"
#include "kernels/team.hpp"

namespace railwave {



/// Node sets with weights (fractions of the set's mass, summing to one) whose mean motion connectors, torques and
/// histories need.
struct NodeSets {
  int count = 0;
  Array<int*> first;           ///< count + 1
  Array<int*> nodes;
  Array<double*> weight;
  Array<double* [6]> motion;   ///< by set: mean position (3, m), mean velocity (3, m/s)
};

/// Weighted mean position and velocity of each set; one team a set, so the order of summation is fixed by the team's size.
struct SetMotion {
  NodeSets sets;
  Array<const double* [3]> position, velocity;

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    const int s = team.league_rank();
    for (int i = 0; i < 3; ++i) {
      double mean_position = 0, mean_velocity = 0;
      const auto range = Kokkos::TeamThreadRange(team, sets.first(s), sets.first(s + 1));
      Kokkos::parallel_reduce(
          range, [&](int k, double& sum) { sum += sets.weight(k) * position(sets.nodes(k), i); }, mean_position);
      Kokkos::parallel_reduce(
          range, [&](int k, double& sum) { sum += sets.weight(k) * velocity(sets.nodes(k), i); }, mean_velocity);
      Kokkos::single(Kokkos::PerTeam(team), [&]() {
        sets.motion(s, i) = mean_position;
        sets.motion(s, 3 + i) = mean_velocity;
      });
    }
  }
};

}  // namespace railwave
