#pragma once

#include <optional>
#include <vector>

#include "signal/fourier.hpp"

namespace railwave {

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
