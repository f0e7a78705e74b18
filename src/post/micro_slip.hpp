#pragma once

#include <vector>

#include "post/field_vectors.hpp"
#include "post/surface_search.hpp"

namespace railwave {

/// Motion of a slave node relative to the place of the master that it is in contact with, thesis 3.4.2.
struct RelativeMotion {
  bool known = false;            ///< the node stands over the master surface
  Vector slip = Vector::Zero();  ///< m/s, in the master's tangent plane (eq. 3.5)
  double parting = 0;            ///< m/s along the master's outward normal: positive where the surfaces part
};

/// Of each of `nodes` of the slave. The master's velocity is interpolated at the node's projection (eq. 3.4, with the
/// inverse of the bilinear map in place of the distances to the sides, so that it holds on any quadrilateral). What the
/// solver found of contact is not used.
std::vector<RelativeMotion> relative_motion(const ContactSide& slave, const std::vector<int>& nodes,
                                            const ContactSide& master, const SurfaceSearch& search);

inline constexpr double slip_force_tolerance = 0.003;    ///< of the largest tangential nodal force, thesis 3.4.3
inline constexpr double slip_velocity_tolerance = 0.05;  ///< m/s, thesis 3.4.3

/// Which of the nodes in contact slip, by three ways of telling: in the order of `nodes`.
struct SlipRegions {
  std::vector<bool> by_force;     ///< mu F_n - F_t below 0.3 % of the largest tangential force of the nodes (eq. 3.6)
  std::vector<bool> by_velocity;  ///< micro-slip above 0.05 m/s (eq. 3.6)
  std::vector<bool> by_solver;    ///< the stick trial failed in the run; empty: the results do not say
};

/// @param nodes      of the slave surface, in contact
/// @param micro_slip m/s, size at each of `nodes`; a node of which it is not known (NaN) does not slip
SlipRegions slip_regions(const ContactState& state, const std::vector<int>& nodes,
                         const std::vector<double>& micro_slip);

int count_of(const std::vector<bool>& marks);

/// Share of the nodes on which two ways of telling agree; 1 without nodes, or where one does not tell.
double agreement(const std::vector<bool>& one, const std::vector<bool>& other);

}  // namespace railwave
