#pragma once

#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace railwave {

enum class SignalKind { psd, wavelet, bandpass, cross, ellipse, speed };

/// What `railwave signal KIND` is asked for. What a kind does not use stays as it is.
struct SignalRequest {
  SignalKind kind = SignalKind::psd;
  std::string results;                                     ///< results file of a run
  std::vector<std::string> channels;                       ///< as read_history() knows them
  bool average = false;                                    ///< each entry's channels become their mean (thesis eq. 3.7)
  double from = -std::numeric_limits<double>::infinity();  ///< s
  double to = std::numeric_limits<double>::infinity();
  double low = 0, high = 0;    ///< Hz, the band; 0: open
  int order = 4;               ///< of the band's filter
  std::string trend = "mean";  ///< taken out first: none, mean, line
  std::string window = "hann";
  double segment = 0;  ///< s; 0: eight segments, or everything where several pairs are averaged
  double overlap = 0.5;
  double w0 = 6, scale_spacing = 0.125;  ///< of the wavelet
  std::optional<std::string> csv, hdf5;  ///< files to write
  bool overwrite = false;                ///< files of others too
};

/// Prints what the analysis found in a few lines, and writes tables where names for them are given: all that
/// docs/signals.md tells. The results file itself is only read. Returns the exit code 0; throws InputError for a file
/// or request that cannot be used.
int signal_command(const SignalRequest& request, std::ostream& out);

}  // namespace railwave
