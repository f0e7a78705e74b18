#pragma once

#include <iosfwd>

#include "model/model.hpp"

namespace railwave {

/// `railwave check`: what a run of this model would be: parts, meshes and their worst elements, step and what sets it,
/// number of steps, memory, the stages of a step, and what the scene leaves out.
void describe_run(Model& model, std::ostream& out);

}  // namespace railwave
