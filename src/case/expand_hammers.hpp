#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// Adds to the scene the node sets, curves, loads and history sets that its hammers and probes stand for, under the
/// names that their sections' help tells. Complains about names that are taken.
void expand_hammers(scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
