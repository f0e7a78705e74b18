#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace railwave {

/// What a stretch of a signal is multiplied by before its transform.
enum class WindowType {
  rectangular,
  hann,         ///< (1 - cos(2 pi n / N)) / 2
  hamming,      ///< 0.54 - 0.46 cos(2 pi n / N)
  flat_top,     ///< five cosines; a peak's height is right within 0.1 % wherever it lies between two frequencies
  tukey,        ///< flat, with a half cosine over `parameter`/2 of the length at either end
  exponential,  ///< exp(-a n / N), which comes down to `parameter` at n = N
};

/// The names above. Throws InputError for another, with a suggestion.
WindowType window_named(const std::string& name);
const std::vector<std::string>& window_names();

/// w_n of n = 0 ... N-1, periodic: w_N would be w_0 (but for the exponential).
/// @param parameter of tukey, 0 to 1; of exponential, above 0
std::vector<double> window(WindowType type, std::size_t length, double parameter = 0.1);

}  // namespace railwave
