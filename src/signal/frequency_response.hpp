#pragma once

#include <cstddef>
#include <vector>

#include "signal/fourier.hpp"

namespace railwave {

/// One blow: force and response at the same even times.
struct Blow {
  std::vector<double> force;     ///< N
  std::vector<double> response;  ///< m/s2
};

struct FrequencyResponse {
  std::vector<double> frequency;   ///< Hz, even
  std::vector<Complex> value;      ///< response over force; 0 where there is no force
  std::vector<double> coherence;   ///< 1 by definition of a single blow
  std::vector<double> force;       ///< N s, root of the mean square of the blows' spectra
};

/// H1 = mean of F* A over mean of F* F, with the coherence |mean F* A|^2 / (mean |F|^2 mean |A|^2) (Bendat and Piersol).
/// With an exponential window, by exp(-decay t) on force and response alike, it is the response at the complex frequency
/// decay + i w exactly: a mode of pole -d + i w_d shows up with d + decay.
/// @param interval s, between samples
/// @param length of the transform; zeros follow the samples
/// Throws std::logic_error for blows of different lengths, or none.
FrequencyResponse frequency_response(const std::vector<Blow>& blows, double interval, std::size_t length, double decay = 0);

/// Acceleration over force divided by s once (mobility) or twice (receptance), s = decay + i w; 0 at 0 Hz without decay.
void integrate(FrequencyResponse& response, int times, double decay = 0);

/// Hz, where the force's spectrum is for the first time so many dB below that at the lowest frequency; the last one if it never is.
double force_limit(const FrequencyResponse& response, double decibels);

}  // namespace railwave
