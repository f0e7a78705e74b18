#pragma once

#include <array>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "post/rigid_slip.hpp"

namespace railwave {

/// What `railwave contact` is asked for.
struct ContactRequest {
  std::string results;                                ///< results file of a run
  std::optional<std::string> csv, nodes, cuts, hdf5;  ///< files to write
  bool overwrite = false;                             ///< files of others too
  std::vector<std::string> together;  ///< names of contacts, with commas, that are one contact solution; may be several
  double from = -std::numeric_limits<double>::infinity();  ///< s: output times before are left out
  double to = std::numeric_limits<double>::infinity();
  /// At so many of the output times taken, evenly chosen with the first and the last, nodes, facets and cuts are found.
  std::size_t most_detailed = std::numeric_limits<std::size_t>::max();
  double interval = 0;  ///< s: an output time nearer than that to the one before that was taken is left out
  std::array<double, 3> rolling_direction{1, 0, 0};
  std::array<double, 2> ring{CreepageRing{}.inner, CreepageRing{}.outer};  ///< see CreepageRing
  std::optional<std::string> axle;         ///< history set that moves as the patches do over ground
  std::optional<double> rolling_velocity;  ///< m/s
};

/// Prints a table of the contact solution at every output time of every contact in a results file, and writes tables in
/// SI units where names for them are given: all that docs/results-file.md says of `railwave contact`. The results file
/// itself is only read. Returns the exit code 0; throws InputError for a file or request that cannot be used.
int contact_command(const ContactRequest& request, std::ostream& out);

}  // namespace railwave
