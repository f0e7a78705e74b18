#pragma once

#include "kernels/materials/bilinear.hpp"
#include "kernels/materials/chaboche.hpp"
#include "kernels/materials/elastic.hpp"
#include "kernels/materials/kinematic_bilinear.hpp"
#include "kernels/support/type_list.hpp"

namespace railwave {

/// Every material of elements; a case's material is the first that is for it (src/model/elements/materials.hpp). CMake
/// reads this line and compiles the kernels of each in files of their own (src/CMakeLists.txt).
using Materials = TypeList<Elastic, Chaboche, KinematicBilinear, Bilinear>;

}  // namespace railwave
