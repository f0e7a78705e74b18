#pragma once

#include <vector>

#include "post/field_vectors.hpp"

namespace railwave {

inline constexpr double slip_force_tolerance = 0.003;    ///< of the largest tangential nodal force, thesis 3.4.3
inline constexpr double slip_velocity_tolerance = 0.05;  ///< m/s, thesis 3.4.3

/// Which of the nodes in contact slip, by three ways of telling: in the order of `nodes`.
struct SlipRegions {
  std::vector<bool> by_force;     ///< mu F_n - F_t below 0.3 % of the largest tangential force of the nodes (eq. 3.6)
  std::vector<bool> by_velocity;  ///< micro-slip above 0.05 m/s (eq. 3.6)
  std::vector<bool> by_solver;    ///< the stick trial failed in the run
};

/// @param nodes      of the slave surface, in contact
/// @param micro_slip m/s, size at each of `nodes`; a node of which it is not known (NaN) does not slip
SlipRegions slip_regions(const ContactState& state, const std::vector<int>& nodes,
                         const std::vector<double>& micro_slip);

int count_of(const std::vector<bool>& marks);

/// Share of the nodes on which two ways of telling agree; 1 without nodes.
double agreement(const std::vector<bool>& one, const std::vector<bool>& other);

}  // namespace railwave
