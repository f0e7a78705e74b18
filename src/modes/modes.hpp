#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "modes/round_body.hpp"
#include "modes/shifted_matrix.hpp"

namespace railwave {

/// One mode of free vibration.
struct Mode {
  double frequency = 0;            ///< Hz; that of its strain energy, 0 for a rigid motion
  bool rigid = false;              ///< it strains nothing
  int part = 0;                    ///< that with the most kinetic energy; -1: point masses and nodes of beams
  double part_share = 0;           ///< of the kinetic energy
  std::optional<RoundName> round;  ///< where that part is a body of revolution
  Eigen::VectorXd shape;           ///< 3 values by node, the largest displacement is 1
  double modal_mass = 0;           ///< kg, of that shape
  int hourglass_part = -1;         ///< that whose hourglass control holds most; -1: of a rigid motion
  double hourglass_share = 0;      ///< of the mode's whole strain energy that it holds
};

/// All modes below a frequency, ascending, and what finding them took.
struct ModeList {
  std::vector<Mode> modes;
  int unknowns = 0;
  long factor_entries = 0;
  SolveQuality solves;
};

/// @param up_to Hz
/// Throws std::runtime_error unless as many are found as the inertia counts.
ModeList modes_below(const Model& model, double up_to);

/// Writes modes for ParaView: `path` (HDF5) and its XDMF companion, in which ParaView's time is the mode's number.
/// Groups:
/// - modes: by mode frequency (Hz), rigid, modal_mass (kg), part (number; names in the file's attribute part_names),
///   kind (0 axial, 1 radial, 2 circumferential), nodal_diameters, nodal_circles (-1: the part is no body of
///   revolution);
/// - fields/PART: coordinates (m), connectivity, displacement (by mode and node; the largest of a mode is 1), and of
///   bodies of revolution the attributes axis_x to axis_z.
/// Throws InputError where no file can be made.
void write_mode_file(const AssembledScene& assembled, const ModeList& list, const std::string& path);

}  // namespace railwave
