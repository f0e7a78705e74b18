#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// Gives every fishplate's mesh the parameters of the rail's mesh that it names; complains where that is no rail.
void fit_fishplates(scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
