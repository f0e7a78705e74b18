#pragma once

#include <string>

#include "model/model.hpp"
#include "solve/monitor/fault.hpp"

namespace railwave {

/// RESULTS.h5 -> RESULTS.fault.h5.
std::string fault_path(const std::string& results_path);

/// Removes both files of an older run's fault; leaves what this program has not written.
void remove_fault_file(const std::string& path);

/// Writes the surroundings of a fault as the run left them, for ParaView: `path` (HDF5) and its XDMF companion. A group
/// for each part that has elements in the box about the fault: parts/NAME with coordinates (undeformed, m),
/// connectivity, every field of case/field_table.hpp that output.fields may name, and by element its number in the
/// model (element) and whether the fault names it (culprit: 1). The box's half edge is watch.box, or six times the
/// culprit's size; a fault without a place has no file. An older run's files of that name are removed. Where none can
/// be made that is told on stderr: the fault itself matters more.
/// @return whether it was written
bool write_fault_file(const Model& model, const Fault& fault, const std::string& path);

}  // namespace railwave
