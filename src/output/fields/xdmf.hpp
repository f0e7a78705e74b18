#pragma once

#include <string>
#include <utility>
#include <vector>

#include "output/file_kind.hpp"
#include "output/output_sets.hpp"

namespace railwave {

/// What the XDMF file must know of one contact surface.
struct XdmfContactSide {
  std::string contact;
  bool slave = true;
  std::size_t node_count = 0;
  std::size_t facet_count = 0;
  std::vector<std::string> fields;  ///< those that are written
};

/// What has values at an output time: each with the number of its own output, from 0.
struct XdmfGrids {
  std::vector<std::pair<const OutputSet*, std::size_t>> sets;
  std::vector<std::pair<const XdmfContactSide*, std::size_t>> sides;
};

/// Companion of a results file, for ParaView: an XML text that names, for every output time, the arrays in the HDF5
/// file. One temporal collection; each time is a spatial collection of one grid for every output set, beams as lines,
/// and one for each side of every contact, all undeformed, with the displacement as an attribute. The arrays that grow
/// with time are named as XDMF's HyperSlab, which vtkXdmfReader (ParaView's "XDMF Reader") knows and vtkXdmf3Reader
/// does not.
class XdmfFile {
 public:
  /// Makes nothing yet. `fields` are those of the case, names of case/field_table.hpp.
  /// @param in_single their precision
  XdmfFile(std::string path, std::string results_file_name, std::vector<std::string> fields,
           FileKind kind = kinds::results_xdmf(), bool in_single = false);

  /// Adds output time number `number`, counted from 0. The first call makes the file; the later ones extend it in
  /// place, and throw if another file has taken its name meanwhile.
  /// @return false: somebody has removed the file, and nothing was written
  [[nodiscard]] bool add(double time, std::size_t number, const XdmfGrids& grids);

  /// Whether nobody has removed it.
  bool is_there() const;

  /// The next add() makes the file.
  void begin_anew() { end_of_times_ = 0; }

 private:
  std::string path_;
  std::string results_file_name_;
  std::vector<std::string> fields_;
  FileKind kind_;
  int float_bytes_;
  unsigned long device_ = 0, inode_ = 0;  ///< of the file that was made
  long end_of_times_ = 0;                 ///< where the next time goes; the closing tags stand there now
};

}  // namespace railwave
