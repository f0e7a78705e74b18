#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace railwave {

/// What `railwave frf` is asked for.
struct ResponseRequest {
  std::vector<std::string> results;      ///< results files: several blows are averaged
  std::string input;                     ///< load or hammer; empty: the only one
  std::vector<std::string> responses;    ///< SET[:DIRECTION]; none: all hammers' and probes' sets along the force
  std::string quantity = "accelerance";  ///< or mobility, receptance
  std::string window = "none";           ///< or exponential
  double window_end = 0.05;              ///< what the exponential window comes down to
  double resolution = 1;                 ///< Hz
  double prominence = 3;                 ///< dB, of the peaks reported
  std::optional<double> from, to;        ///< Hz
  std::optional<std::string> csv, hdf5;
  bool overwrite = false;  ///< files of others too
};

/// Frequency responses of a hammer test: prints their peaks and troughs, and writes them line by line where files are
/// named: all that docs/hammer.md says of `railwave frf`. Returns the exit code 0; throws InputError for a file or
/// request that cannot be used.
int response_command(const ResponseRequest& request, std::ostream& out);

}  // namespace railwave
