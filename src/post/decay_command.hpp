#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace railwave {

/// What `railwave decay` is asked for.
struct DecayRequest {
  std::vector<std::string> results;  ///< results files: several blows are averaged
  std::string input;                 ///< load or hammer; empty: the only one
  std::vector<std::string> rows;     ///< rows of probes, or sets; none: all probes on the struck part
  std::string at;                    ///< set that stands for the force's own place; empty: the struck one
  std::string direction;             ///< as of `railwave frf`; empty: that of the force
  double from = 100, to = 5000;      ///< Hz
  double resolution = 1;             ///< Hz
  std::string window = "none";       ///< or exponential
  double window_end = 0.05;          ///< what the exponential window comes down to
  std::optional<std::string> csv, hdf5;
  bool overwrite = false;  ///< files of others too
};

/// Decay rates in third-octave bands by EN 15461, from a row of probes beside one hammer (by reciprocity the same as
/// from one accelerometer and a row of blows). Returns the exit code 0; throws InputError for a file or request that
/// cannot be used.
int decay_command(const DecayRequest& request, std::ostream& out);

}  // namespace railwave
