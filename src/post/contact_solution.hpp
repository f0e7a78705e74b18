#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <string>

#include "model/fields.hpp"

namespace railwave {

/// Contact solution of one pair at one instant, from the nodal forces of its slave surface (thesis 3.4). Forces are those
/// on the slave. Longitudinal and lateral are the global x and y, turned into the tangent plane of the patch.
struct ContactSolution {
  int nodes = 0;                       ///< in contact: normal force above `contact_threshold`
  double area_by_count = 0;            ///< m2, sum of the areas of the nodes in contact
  double area = 0;                     ///< m2, inside the zero line of the pressure (post/patch_area.hpp)
  double peak_nodal_pressure = 0;      ///< Pa, largest normal force of a node over the node's area
  double peak_facet_pressure = 0;      ///< Pa, largest sum of a facet's four nodal forces over that of their areas (eq. 3.3)
  double peak_shear = 0;               ///< Pa, largest tangential force of a node over the node's area
  double normal_force = 0;             ///< N, size of the sum
  double creep_force = 0;              ///< N, longitudinal
  double lateral_force = 0;            ///< N
  double traction_coefficient = 0;     ///< tangential over normal force
  std::array<double, 3> centre{};      ///< m, of the normal force
  std::array<double, 3> normal{};      ///< direction of the normal force
  int slipping_by_force = 0;           ///< nodes with mu F_n - F_t below 0.3 % of the largest tangential force (eq. 3.6)
  int slipping_by_velocity = 0;        ///< nodes with a micro-slip above 0.05 m/s (eq. 3.6)
  int slipping_by_solver = 0;          ///< nodes whose stick trial failed in the run
};

inline constexpr double contact_threshold = 1e-3;       ///< N, thesis 3.4.1
inline constexpr double slip_force_tolerance = 0.003;   ///< of the largest tangential nodal force, thesis 3.4.3
inline constexpr double slip_velocity_tolerance = 0.05; ///< m/s, thesis 3.4.3

ContactSolution contact_solution(const ContactState& state);

/// `railwave contact`: prints a table of the contact solution at every output time of every contact in a results file, and
/// writes it as CSV in SI units where a name for that is given. Returns the exit code 0; throws InputError for a file
/// that cannot be used.
int contact_command(const std::string& file, const std::optional<std::string>& csv, std::ostream& out);

}  // namespace railwave
