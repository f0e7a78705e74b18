#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// Fills the points of curves given as files: columns of time in s and value, as case/number_table.hpp reads them.
/// Complains with the file's line about everything else, and about times that do not increase. What was read is added
/// to the scene's static text, so that a changed file settles anew.
void read_curves(scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
