#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

/// Signals with a known answer.
namespace railwave::made_up {

/// White noise of the standard deviation asked for, the same on every machine: normal by Box and Muller from a 64-bit
/// mixer.
inline std::vector<double> noise(std::size_t length, double deviation, std::uint64_t seed) {
  std::uint64_t state = seed;
  const auto uniform = [&] {
    state += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return (static_cast<double>(z >> 11) + 0.5) / 9007199254740992.0;
  };
  std::vector<double> values(length);
  for (double& value : values) {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    value = deviation * radius * std::cos(2 * M_PI * uniform());
  }
  return values;
}

/// amplitude cos(2 pi frequency n interval + phase)
inline std::vector<double> cosine(std::size_t length, double interval, double amplitude, double frequency,
                                  double phase = 0) {
  std::vector<double> values(length);
  for (std::size_t n = 0; n < length; ++n)
    values[n] = amplitude * std::cos(2 * M_PI * frequency * static_cast<double>(n) * interval + phase);
  return values;
}

}  // namespace railwave::made_up
