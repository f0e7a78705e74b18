#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// Gives the meshes of fishplates and rail pads the parameters of the rail's mesh that each names; complains where that
/// is no rail.
void fit_to_rails(scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
