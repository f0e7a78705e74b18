#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace railwave {

/// Contacts whose patch will come to an end of a surface, or leave the fine zone of a part, before the run ends: one
/// line each, with time and place. Each part goes on as its initial motion and its prescribed motions say, as a rigid
/// body. A patch goes with the axis of the round part of its contact; without one, with the part whose surface is the
/// shorter along the way, and then its foremost node counts. On a patch that goes with a round part three elements lie
/// ahead of its middle: how large it becomes is not known before the run. What a surface ends at, and where it goes on
/// behind a gap, is as in model/contact/surface_ends.hpp.
std::vector<std::string> path_doubts(const Model& model);

}  // namespace railwave
