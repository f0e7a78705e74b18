#pragma once

#include <vector>

#include "mesh/sections/section.hpp"

namespace railwave {

/// Shifts boundary nodes along their normals so that the section's polygon encloses as much as the outline which its
/// nodes lie on: each edge's area between chord and outline is shared by its two ends. Chords would otherwise cut area
/// and bending stiffness off every rounding. `outline` is closed, counter-clockwise and finely sampled;
/// `kept[n]` tells which nodes have to stay on it.
void match_outline_area(SectionMesh& section, const std::vector<Point2>& outline, const std::vector<char>& kept);

/// Points on a closed curve, `spacing` apart.
std::vector<Point2> sample_closed(const Curve& curve, double spacing);

}  // namespace railwave
