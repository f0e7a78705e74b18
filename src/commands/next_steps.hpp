#pragma once

#include <iosfwd>

#include "case/scene.hpp"

namespace railwave {

/// After a run: where its results lie, how it goes on if it has not come to its end, and which commands look at them.
void tell_next_steps(const scene::Scene& scene, bool completed, std::ostream& out);

/// What `railwave run` of this scene would refuse to replace, as a note; nothing where it replaces nothing that can be
/// lost.
void tell_what_gets_lost(const scene::Scene& scene, std::ostream& out);

}  // namespace railwave
