#pragma once

#include <string>

#include "model/model.hpp"

namespace railwave {

/// Writes what a run would begin with, for ParaView: `path` (HDF5) and its XDMF companion. Groups:
/// - parts/NAME: coordinates (m), connectivity, and by element part and material (their numbers, names in the file's
/// attributes
///   part_names and material_names), stable_step (s) by the case's estimate, step_ratio (that over the least of all
///   elements);
/// - surfaces/PART.NAME: coordinates, connectivity of quadrilaterals; node_sets/PART.NAME: coordinates; whole parts are
/// left out;
/// - connectors: coordinates, connectivity of lines, and by line connector (number, names in connector_names),
/// stiffness (N/m) and
///   damping (N s/m), the largest along the axes. Ground is drawn a bit away from the other end.
/// Throws InputError where no file can be made.
void write_model_file(const Model& model, const std::string& path);

}  // namespace railwave
