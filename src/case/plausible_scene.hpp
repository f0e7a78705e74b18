#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// Warns of what is odd about a whole scene, where no single key tells: wheels faster than any train.
void remark_on_scene(const scene::Scene& scene, Complaints& remarks);

}  // namespace railwave::case_file
