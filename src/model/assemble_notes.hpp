#pragma once

#include <string>
#include <vector>

#include "model/assembly.hpp"

namespace railwave {

/// assemble(), with a line in `notes` about each thing of a mesh file that was left out or renamed.
Assembly assemble(const scene::Scene& scene, std::vector<std::string>& notes);

}  // namespace railwave
