#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace railwave {

/// What in a scene may be meant but more often is a mistake, a line each with the case's entries and lines, and how to
/// mend it: round parts that begin by sliding, loads on nodes that are held, parts and contact surfaces that overlap,
/// initial motions that a prescribed motion contradicts, entries without effect, contacts that will come to an end of
/// their surfaces. Told by `railwave check`, at a run's start and in its summary.
std::vector<std::string> scene_doubts(const Model& model);

/// Those of them that concern meshes and what joins them, whatever moves: told by `railwave modes` too.
std::vector<std::string> mesh_doubts(const Model& model);

}  // namespace railwave
