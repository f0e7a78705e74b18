#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// Two wheels on a solid axle along y, in one mesh: the axle shares the nodes of the bores. The origin is the axle's
/// middle, the tape circles lie in y = +-(flange_back_distance / 2 + 0.070 m), the flanges inside. The half at y > 0 is
/// a wheel as mesh/wheel.hpp makes it; the other is its mirror image. Sets: those of a wheel; element sets wheel and
/// axle; surfaces skin (the axle's beside the hubs), journal, axle_end; node set middle, in y = 0. A half has a surface
/// middle there. With both halves each set covers both, and left_NAME (y > 0), right_NAME one. The wheel's coarse_size
/// is taken as much smaller as makes an even number of cells round the bore, or its zone a few cells longer. Throws
/// InputError if the parameters don't fit.
Mesh wheelset_mesh(const scene::MeshSource& source);

/// About how many elements it has, without making it. Throws InputError if the wheel's parameters don't fit.
double wheelset_elements(const scene::MeshSource& source);

}  // namespace railwave
