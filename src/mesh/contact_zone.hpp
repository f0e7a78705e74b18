#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"

namespace railwave {

/// How wheel and rail are compared.
namespace contact_zone {

/// m, vertical: profiles that are no farther apart may touch under load.
inline constexpr double opening = 6e-5;
/// m, from one lateral position to the next.
inline constexpr double lateral_step = 1e-4;
/// m along the wheel's profile, from one lateral position to the next: more is a jump to another place.
inline constexpr double jump = 4e-3;

}  // namespace contact_zone

/// Gives the wheels and rails of the scene with zone = "contact" their contact bands (zone_centre, zone_width), and the
/// meshes that are fitted to such rails too: for each contact of a wheel with rails, the parts of both profiles that
/// come within 0.06 mm of each other while the wheel, at its place, angle of attack and roll, moves along y from
/// zone_lateral_start to zone_lateral_end, and zone_margin more on both sides. A mesh in several contacts has them all.
/// Returns a line for each place where the profiles meet first, jump to another one, and meet last, and one for each
/// band. Throws InputError where a mesh with zone = "contact" has no such contact, or profiles never meet.
std::vector<std::string> place_contact_zones(scene::Scene& scene);

}  // namespace railwave
