#pragma once

#include <vector>

#include "signal/fourier.hpp"

namespace railwave {

/// A third-octave band of base ten (IEC 61260).
struct ThirdOctave {
  double nominal = 0;        ///< Hz, what it is called: 100, 125, 160 ...
  double centre = 0;         ///< Hz, 1000 times a tenth power of ten
  double low = 0, high = 0;  ///< Hz
};

/// Bands that lie between two frequencies (Hz, above 0) as a whole.
std::vector<ThirdOctave> third_octaves(double from, double to);

/// Responses at a distance from the force, all over the same frequencies.
struct PlacedResponse {
  double distance = 0;  ///< m
  std::vector<Complex> value;
};

/// Track decay rate of a band.
struct BandDecay {
  ThirdOctave band;
  double rate = 0;            ///< dB/m
  double least = 0;           ///< dB/m, the smallest that a row so long can tell: 4.343 over its length
  std::vector<double> level;  ///< dB, of each place, over the first one
};

/// The decay rate by EN 15461: 4.343 / (sum over n of |A(x_n)|^2 / |A(x_0)|^2 dx_n), squares summed over the lines of a
/// band; dx_n is half the distance between the neighbours of x_n, of x_0 half that to x_1, and of the last one as if
/// another followed equally far.
/// @param places the first one at the force, distances ascending
/// Throws std::logic_error for fewer than two places, or distances that do not ascend.
std::vector<BandDecay> decay_rates(const std::vector<double>& frequency, const std::vector<PlacedResponse>& places,
                                   const std::vector<ThirdOctave>& bands);

}  // namespace railwave
