#pragma once

#include <string>

namespace railwave::verify {

/// A steel block of 0.1 x 0.1 x 0.1 m that a driven force pulls along z: a case file.
inline const std::string driven_block = R"(
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.block]
type = "box"
size = [0.1, 0.1, 0.1]
divisions = [3, 3, 3]
[parts.block]
mesh = "block"
material = "steel"
[curves.pull]
type = "table"
points = [[0, 0]]
[loads.pull]
type = "nodal_force"
target = "block.z_max"
force = [0, 0, 1]
curve = "pull"
[time]
end = 1e-3
[output]
history_sets = ["block.z_max"]
field_sets = ["block"]
fields = ["displacement", "stress"]
)";

}  // namespace railwave::verify
