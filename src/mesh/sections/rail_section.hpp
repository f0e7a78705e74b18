#pragma once

#include <string>
#include <vector>

#include "mesh/sections/section.hpp"

namespace railwave {

struct RailSectionPlan {
  std::string section;
  double inclination = 0;
  double zone_centre = 0;  ///< y after inclination
  double zone_width = 0;
  double zone_size = 0;
  double growth = 1.25;
  double section_size = 0;
  int zone_layers = 3;
  int web_columns = 3;
  bool lower_transition = false;  ///< a second longitudinal transition, in the web
};

/// The three sides of a fishing chamber, from the head to the foot: each a line NAME_left (towards -y) and NAME_right.
inline constexpr const char* fishing_lines[3] = {"underside", "web", "foot_top"};

/// Quads of a rail's section before inclination: a ring of layers follows the running surface from one lower corner of
/// the head to the other (zone layers, then the longitudinal transition), round a core; then web and foot.
/// Edges head (contact band and a margin of two columns) and running_surface; node set foot; lines of `fishing_lines`.
/// Levels 0 to 1, or 2 with the lower transition. Throws std::invalid_argument with a sentence when the plan does not
/// fit the section.
/// @param smoothed false: only its quads count, not where the nodes lie, which takes a fraction of the time
SectionMesh rail_section(const RailSectionPlan& plan, bool smoothed = true);

}  // namespace railwave
