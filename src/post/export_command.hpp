#pragma once

#include <iosfwd>
#include <limits>
#include <optional>
#include <string>

namespace railwave {

/// What `railwave export` is asked for.
struct ExportRequest {
  std::string results;             ///< results file of a run
  bool vtkhdf = false;             ///< the format, the only one
  std::optional<std::string> out;  ///< file to write; none: RESULTS with the ending .vtkhdf
  /// Names of the sets and beams to take, with commas; empty: all whose elements are not all in another.
  std::string show;
  double from = -std::numeric_limits<double>::infinity();  ///< s: output times before are left out
  double to = std::numeric_limits<double>::infinity();
  bool overwrite = false;  ///< files of others too
};

/// Writes the fields of a results file for another program: all that docs/results-file.md says of `railwave export`.
/// The results file itself is only read.
/// @param out gets the names of the sets, what was left out, and where the file is
/// @return the exit code 0
/// Throws InputError where no format is asked for, a set has no fields, no output lies between the times, the results
/// are damaged, or the file may not be replaced.
int export_command(const ExportRequest& request, std::ostream& out);

}  // namespace railwave
