#pragma once

#include <iosfwd>

#include "model/model.hpp"

namespace railwave {

/// What a user should know of a case that is taken as it is, before anything else: "warning: ..." or "note: ...", a
/// line each.
void tell(const char* kind, const std::vector<std::string>& lines, std::ostream& out);

/// `railwave check`: what a run of this model would be: parts, meshes and their worst elements, step and what sets it,
/// number of steps, memory, the tasks of a step, and what the scene leaves out.
void describe_run(Model& model, std::ostream& out);

}  // namespace railwave
