#pragma once

#include <string>

#include "modes/modes.hpp"

namespace railwave {

/// Writes modes for ParaView: `path` (HDF5) and its XDMF companion, in which ParaView's time is the mode's number.
/// Groups:
/// - modes: by mode frequency (Hz), rigid, modal_mass (kg), part (number; names in the file's attribute part_names),
/// and
///   kind (0 axial, 1 radial, 2 circumferential), nodal_diameters, nodal_circles (-1: the part is no body of
///   revolution);
/// - fields/PART: coordinates (m), connectivity, displacement (by mode and node; the largest of a mode is 1), and of
/// bodies of
///   revolution the attributes axis_x to axis_z.
/// Throws InputError where no file can be made.
void write_mode_file(const Model& model, const ModeList& list, const std::string& path);

}  // namespace railwave
