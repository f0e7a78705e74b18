#pragma once

#include <vector>

#include "signal/fourier.hpp"

namespace railwave {

/// How fast something runs along a row of probes, by when it comes past each.
struct TimeOfFlight {
  std::vector<double> lag;         ///< s, of each probe behind the first, from a top of their correlation
  std::vector<double> similarity;  ///< that correlation, 1: the same signal but for size
  double speed = 0;                ///< m/s, along the row; below 0: it comes from the other end
  double standard_error = 0;       ///< m/s, from the scatter about the straight line
  double scatter = 0;              ///< s, root mean square of lags about the straight line
};

/// @param signals of each probe, at the same times, along the row
/// @param distance m, of each probe along the row
/// Lags are found between samples: the correlation is interpolated as the band-limited function that it is, eightfold,
/// and by a parabola there. Each is the top nearest to the lag of the probe before and the step from that one on, lest
/// it be a period off. Throws InputError where a probe does not move or nothing travels.
TimeOfFlight time_of_flight(const std::vector<std::vector<double>>& signals, const std::vector<double>& distance,
                            double interval);

/// Power by frequency and wave number, and its ridge.
struct FrequencyWavenumber {
  std::vector<double> frequency;           ///< Hz, those of the band
  std::vector<double> wavenumber;          ///< 1/m, cycles; above 0: it runs towards larger distances
  std::vector<std::vector<double>> power;  ///< [frequency][wavenumber], of the largest
  std::vector<double> ridge;               ///< 1/m, where the power of each frequency is largest
  std::vector<double> ridge_power;         ///< of the largest
  double speed = 0;                        ///< m/s, frequency over wave number of the ridge, weighted by power
  double scatter = 0;  ///< m/s, root mean square of frequency over wave number about that, weighted by power
};

/// Transform over time, and over distances as they are, of signals under Hann's window along the row (probes far from
/// even distances are allowed, but wave numbers beyond half of one over their mean distance are not looked at). The
/// speed is that of the ridge where it has more than a hundredth of the largest power. Throws InputError for fewer than
/// four probes, or a band that holds nothing.
FrequencyWavenumber frequency_wavenumber(const std::vector<std::vector<double>>& signals,
                                         const std::vector<double>& distance, double interval, double low, double high);

}  // namespace railwave
