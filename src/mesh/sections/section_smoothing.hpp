#pragma once

#include "mesh/sections/section.hpp"

namespace railwave {

struct SmoothingResult {
  int sweeps = 0;
  double worst_corner = 0;  ///< smallest corner Jacobian over that of the ideal corner (1 is ideal, < 0 inverted)
};

/// Moves the free nodes of a section, and those on curves along their curve, so that each quad comes close to its ideal
/// shape and size: minimises the sum over quad corners of |T|^2 / (2 det T) - 1 + (det T + 1 / det T - 2) / 2, where T
/// maps the ideal corner onto the present one (target-matrix optimisation, Knupp 2012). The determinant is regularised
/// while quads are inverted, so that the start may be tangled. Fixed nodes stay.
SmoothingResult smooth_section(SectionMesh& section, int max_sweeps = 400);

}  // namespace railwave
