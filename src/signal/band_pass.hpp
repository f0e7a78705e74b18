#pragma once

#include "signal/fourier.hpp"

namespace railwave {

/// A Butterworth filter run forward and back, so that nothing is delayed: each frequency is multiplied by 1 / (1 + q^(2
/// order)), a half at the edges, q = (f^2 - low high) / (f (high - low)) in a band; f / high below an edge alone, low /
/// f above one.
struct Band {
  double low = 0;   ///< Hz; 0: no lower edge
  double high = 0;  ///< Hz; 0: no upper edge
  int order = 4;
};

double band_gain(const Band& band, double frequency);

/// The values within the band. Beyond its ends the record is continued by its own point reflection, which fades over
/// two periods of the lower edge. Throws InputError for edges that are not in order, or above half the sampling
/// frequency.
std::vector<double> band_passed(const std::vector<double>& values, double interval, const Band& band);

/// The analytic signal: the values, and as imaginary part the same a quarter period later, at every frequency.
std::vector<Complex> analytic_signal(const std::vector<double>& values);

}  // namespace railwave
