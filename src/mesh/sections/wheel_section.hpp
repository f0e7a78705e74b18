#pragma once

#include "case/scene.hpp"
#include "mesh/sections/section.hpp"

namespace railwave {

/// Quads of a wheel's section; the section's z is the radius. Layers follow the running surface from the flange's back
/// to the field side: zone layers, the first longitudinal transition, the merging of the band's columns, the rim; then
/// web and hub. Edges tread (contact band and a margin of two columns) and running_surface; node set bore. Levels 0 to
/// 1, or 2 with the second transition in the web. Throws std::invalid_argument with a sentence when the band doesn't
/// fit.
/// @param smoothed false: only its quads count, not where the nodes lie, which takes a fraction of the time
SectionMesh wheel_section(const scene::WheelMesh& wheel, bool lower_transition, bool smoothed = true);

/// The running surface from the flange's back (or the inner side of a cone) to the end of the profile, radius over y.
Curve wheel_running_surface(const scene::WheelMesh& wheel);

/// Radius of the running surface at a lateral position.
double wheel_surface_radius(const scene::WheelMesh& wheel, double y);

}  // namespace railwave
