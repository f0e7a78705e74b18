#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// Fills the points of curves given as files, CSV of time in s and value; lines that begin with something else than a
/// number may stand before the first pair. Complains with the file's line about everything else, and about times that
/// do not increase. What was read is added to the scene's static text, so that a changed file settles anew.
void read_curves(scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
