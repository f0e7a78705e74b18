#pragma once

#include <string>
#include <vector>

#include "model/assembled_scene.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/contact/contact_pair.hpp"

namespace railwave {

/// What in a scene may be meant but more often is a mistake, a line each with the case's entries and lines, and how to
/// mend it: round parts that begin by sliding, loads on nodes that are held, parts and contact surfaces that overlap,
/// initial motions that a prescribed motion contradicts, entries without effect, contacts that will come to an end of
/// their surfaces. Reported by `railwave check`, at a run's start and in its summary.
/// @param step_size s, of the run
std::vector<std::string> scene_doubts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                                      const AbsorbingLayers& absorbing, double step_size);

/// Those of them that concern meshes and what joins them, whatever moves: reported by `railwave modes` too.
std::vector<std::string> mesh_doubts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                                     double step_size);

/// Contacts whose patch will come to an end of a surface, or leave the fine zone of a part, before the run ends: one
/// line each, with time and place. Each part goes on as its initial motion and its prescribed motions say, as a rigid
/// body. A patch goes with the axis of the round part of its contact; without one, with the part whose surface is the
/// shorter along the way, and then its foremost node counts. On a patch that goes with a round part three elements lie
/// ahead of its middle: how large it becomes is not known before the run. What a surface ends at, and where it goes on
/// behind a gap, is as in model/contact/surface_ends.hpp. Computed in model/contact/contact_paths.cpp.
std::vector<std::string> path_doubts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts);

}  // namespace railwave
