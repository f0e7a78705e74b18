#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "signal/fourier.hpp"

namespace railwave {

/// One blow: force and displacement at the same even times, and the velocity at the first and the last of them.
struct Blow {
  std::vector<double> force;                     ///< N
  std::vector<double> displacement;              ///< m
  double first_velocity = 0, last_velocity = 0;  ///< m/s
};

struct FrequencyResponse {
  std::vector<double> frequency;  ///< Hz, even
  std::vector<Complex> value;     ///< acceleration over force, m/s2/N; 0 where there is no force
  std::vector<double> coherence;  ///< 1 by definition of a single blow
  std::vector<double> force;      ///< N s, root of the mean square of the blows' spectra
};

/// Acceleration over force, H1 = mean of F* A over mean of F* F, with the coherence |mean F* A|^2 / (mean |F|^2 mean
/// |A|^2) (Bendat and Piersol 2010). The acceleration's transform over the record is s^2 times that of the displacement
/// less a cubic which has its values and velocities at both ends, plus that of the cubic's own acceleration: a mesh's
/// vibrations above half the sampling rate fold back into sampled accelerations, but hardly into displacements; and
/// without the cubic the record's end would count as a jump. With an exponential window, by exp(-decay t) on force and
/// response alike, it is the response at the complex frequency s = decay + i w exactly: a mode of pole -d + i w_d shows
/// up with d + decay.
/// @param interval s, between samples
/// @param length of the transform; zeros follow the samples
/// Throws std::logic_error for blows of different lengths, or none.
FrequencyResponse frequency_response(const std::vector<Blow>& blows, double interval, std::size_t length,
                                     double decay = 0);

/// Acceleration over force divided by s once (mobility) or twice (receptance), s = decay + i w; 0 at 0 Hz without
/// decay.
void integrate(FrequencyResponse& response, int times, double decay = 0);

/// Hz, where the force's spectrum is for the first time so many dB below that at the lowest frequency; the last one if
/// it never is.
double force_limit(const FrequencyResponse& response, double decibels);

/// A peak or a trough of a frequency response's amplitude.
struct Resonance {
  bool peak = true;
  double frequency = 0;           ///< Hz, of the parabola through three lines of the level in dB
  double amplitude = 0;           ///< of that
  double prominence = 0;          ///< dB, above the higher of the troughs on its sides (below the lower of the peaks)
  std::optional<double> damping;  ///< of critical, by half power: width at 3 dB over twice the frequency; absent where
                                  ///< another is too near
};

/// Peaks and troughs at least so prominent, in the order of frequency; none at the ends.
/// @param decay 1/s, of an exponential window: its share of the damping is taken off
std::vector<Resonance> find_resonances(const std::vector<double>& frequency, const std::vector<Complex>& value,
                                       double prominence, double decay = 0);

}  // namespace railwave
