#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"

namespace railwave {

/// Gives the wheels and rails of the scene with zone = "contact" their contact bands (zone_centre, zone_width), and the
/// meshes that are fitted to such rails too: for each contact of a wheel with rails, the parts of both profiles that
/// come within 0.06 mm of each other while the wheel, at its place, angle of attack and roll, moves along y from
/// zone_lateral_start to zone_lateral_end, and zone_margin more on both sides. A mesh in several contacts has them all.
/// Returns a line for each place where the profiles meet first, jump to another one, and meet last, and one for each
/// band. Throws InputError where a mesh with zone = "contact" has no such contact, or profiles never meet.
std::vector<std::string> place_contact_zones(scene::Scene& scene);

}  // namespace railwave
