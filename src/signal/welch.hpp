#pragma once

#include "signal/fourier.hpp"
#include "signal/trend.hpp"
#include "signal/window.hpp"

namespace railwave {

/// How Welch's method (Welch 1967) cuts a signal up.
struct WelchOptions {
  std::size_t segment = 0;  ///< samples in each; 0: such that there are eight, or one of everything if that is short
  double overlap = 0.5;     ///< share of a segment that the next has too, below 1
  WindowType window = WindowType::hann;
  double window_parameter = 0.1;
  Trend trend = Trend::mean;  ///< taken out of each segment
};

/// Averages over the segments, by frequency: one-sided densities, so that their integral over frequency is the mean
/// square (of segments without trend); in units of the signals, products over Hz. The window's mean square is allowed
/// for.
struct CrossSpectra {
  std::vector<double> frequency;  ///< Hz
  std::vector<double> density_a, density_b;
  std::vector<Complex> cross;  ///< mean of conj(A) B: its angle is the phase of b before a
  std::size_t segments = 0;    ///< how many were averaged
  std::size_t segment_length = 0;

  /// |cross|^2 / (density_a density_b), 0 to 1; 0 where either is 0. Of a single segment it is 1 whatever the signals.
  std::vector<double> coherence() const;
  std::vector<double> phase() const;  ///< rad, of b before a
};

/// Number of samples in a segment, from the options.
std::size_t segment_length(std::size_t signal_length, const WelchOptions& options);

/// Welch's averages of pairs of signals of equal length, over the segments of all pairs. Throws std::logic_error for
/// none, or unequal lengths; InputError for a segment longer than the signals.
CrossSpectra cross_spectra(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                           double interval, const WelchOptions& options);

/// One-sided power spectral density of one signal, units squared over Hz.
struct PowerDensity {
  std::vector<double> frequency, density;
  std::size_t segments = 0, segment_length = 0;
};
PowerDensity power_density(const std::vector<double>& values, double interval, const WelchOptions& options);

/// Integral of a density from `low` to `high` Hz, each value standing for the band of one frequency's width about it.
double band_power(const std::vector<double>& frequency, const std::vector<double>& density, double low, double high);

}  // namespace railwave
