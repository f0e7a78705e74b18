#pragma once

#include <iosfwd>

#include "case/scene.hpp"
#include "model/model.hpp"

namespace railwave {

/// What a user should know of a case that is taken as it is, before anything else: "warning: ..." or "note: ...", a
/// line each.
void report(const char* kind, const std::vector<std::string>& lines, std::ostream& out);

/// `railwave check`: what a run of this model would be: parts, meshes and their worst elements, step and what sets it,
/// number of steps, memory, the tasks of a step, and what the scene leaves out.
void describe_run(Model& model, std::ostream& out);

/// After a run: where its results lie, how it goes on if it has not come to its end, and which commands look at them.
void report_next_steps(const scene::Scene& scene, bool completed, std::ostream& out);

/// What `railwave run` of this scene would refuse to replace, as a note; nothing where it replaces nothing that can be
/// lost.
void report_what_gets_lost(const scene::Scene& scene, std::ostream& out);

}  // namespace railwave
