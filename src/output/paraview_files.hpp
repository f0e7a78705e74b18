#pragma once

#include <string>
#include <vector>

#include "model/assembled_scene.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/ties.hpp"
#include "model/elements/element_model.hpp"
#include "model/loads/connector_cells.hpp"
#include "model/nodal_state.hpp"
#include "solve/monitor/fault.hpp"

/// Files besides the results that show a model in ParaView: what a run begins with, and the surroundings of its fault.
namespace railwave {

/// Writes what a run would begin with, for ParaView: `path` (HDF5) and its XDMF companion. Groups:
/// - parts/NAME: coordinates (m), connectivity, and by element part and material (their numbers; names in the file's
///   attributes part_names and material_names), stable_step (s) by the case's estimate, step_ratio (that over the least
///   of all elements), and rank, where `ranks` has that of each element, in the model's order; empty: no rank;
/// - surfaces/PART.NAME: coordinates, connectivity of quadrilaterals; node_sets/PART.NAME: coordinates; whole parts are
///   left out;
/// - connectors: coordinates, connectivity of lines, and by line connector (number, names in connector_names),
///   stiffness (N/m) and damping (N s/m), the largest along the axes. Ground is drawn a bit away from the other end.
/// Throws InputError where no file can be made.
void write_model_file(const AssembledScene& assembled, const AbsorbingLayers& absorbing,
                      const std::vector<ConnectorCell>& connectors, const std::string& path,
                      const std::vector<int>& ranks = {});

/// RESULTS.h5 -> RESULTS.fault.h5.
std::string fault_path(const std::string& results_path);

/// Removes both files of an older run's fault; leaves what this program has not written.
void remove_fault_file(const std::string& path);

/// Writes the surroundings of a fault as the run left them, for ParaView: `path` (HDF5) and its XDMF companion. A group
/// for each part that has elements in the box about the fault: parts/NAME with coordinates (undeformed, m),
/// connectivity, every field of case/field_table.hpp that output.fields may name, and by element its number in the
/// model (element) and whether the fault names it (culprit: 1). The box's half edge is monitor.box, or six times the
/// culprit's size; a fault without a place has no file. An older run's files of that name are removed. If it
/// cannot be written, that is reported on stderr only: the fault itself matters more.
/// @return whether it was written
bool write_fault_file(const AssembledScene& assembled, const ElementModel& elements, const NodalState& nodal,
                      const Ties& ties, const Fault& fault, const std::string& path);

}  // namespace railwave
