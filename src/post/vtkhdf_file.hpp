#pragma once

#include <string>
#include <vector>

#include "post/field_sets.hpp"
#include "post/own_file.hpp"

namespace railwave {

/// An output time of some sets.
struct ExportedTime {
  double time = 0;                   ///< s
  std::vector<std::size_t> sets;     ///< those that have values then, positions among the exported ones, ascending
  std::vector<std::size_t> outputs;  ///< the number of each one's own output
};

/// Times of all the sets from `from` to `to`, s, each once.
std::vector<ExportedTime> times_of(const std::vector<FieldSet>& sets, double from, double to);

FileKind vtkhdf_kind();

/// Writes sets as one unstructured grid in the format VTKHDF [VTK 2026]: version 2.0 with the group Steps; of a single
/// time version 1.0 without it, which older readers know, the time as field data `TimeValue` (s). Cells are undeformed;
/// points and cells of the sets come one set after the other. Where all times have the same sets their mesh is stored
/// once.
/// - PointData: fields of nodes, and `node` (number in the model);
/// - CellData: fields of elements, `beam_force` (N) and `beam_moment` (N m) along the beam's own axes, `element`
/// (number
///   in the model), `set` (position in the file's attribute set_names).
/// A field that a set has not is not-a-number there. Throws InputError where no file can be made.
/// @param times one or more
void write_vtkhdf_file(const std::string& path, const ResultsReader& results, const std::vector<FieldSet>& sets,
                       const std::vector<ExportedTime>& times);

}  // namespace railwave
