#pragma once

#include <string>

#include "model/model.hpp"
#include "solve/fault.hpp"

namespace railwave {

/// RESULTS.h5 -> RESULTS.fault.h5.
std::string fault_path(const std::string& results_path);

/// Removes both files of an older run's fault; leaves what this program has not written.
void remove_fault_file(const std::string& path);

/// Writes the surroundings of a fault as the run left them, for ParaView: `path` (HDF5) and its XDMF companion. A group
/// for each part that has elements in the box about the fault: parts/NAME with coordinates (undeformed, m),
/// connectivity, displacement (m), velocity (m/s) and acceleration (m/s2) by node, and by element stress (xx, yy, zz,
/// xy, yz, zx, Pa), plastic_strain, element (the model's number) and culprit (1: the element that the fault names). The
/// box's half edge is watch.box, or six times the culprit's size; a fault without a place has no file. An older run's
/// files of that name are removed. Where none can be made that is told on stderr: the fault itself matters more.
/// @return whether it was written
bool write_fault_file(const Model& model, const Fault& fault, const std::string& path);

}  // namespace railwave
