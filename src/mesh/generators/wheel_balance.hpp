#pragma once

#include "case/scene.hpp"
#include "mesh/extrusion.hpp"
#include "mesh/grading.hpp"
#include "mesh/sections/section.hpp"

namespace railwave {

/// Moves a turned wheel's nodes from and towards the axle so that the mesh has its centre of mass on the axle and the
/// volume of its section turned about it, whatever the widths of its cells. The running surface and all else down to
/// the first change of level stay where they are: there the wheel is true.
void balance_wheel(Extrusion& extrusion, const SectionMesh& section, const Stations& stations,
                   const scene::WheelMesh& wheel);

}  // namespace railwave
