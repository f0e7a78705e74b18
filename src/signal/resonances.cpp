#include <algorithm>
#include <cmath>
#include <limits>

#include "signal/frequency_response.hpp"

namespace railwave {
namespace {

constexpr double half_power = 3.010299956639812;  ///< dB

/// The least level on one side of a peak before the curve gets higher than the peak.
double foot(const std::vector<double>& level, std::size_t peak, int side) {
  double least = level[peak];
  for (auto k = static_cast<std::ptrdiff_t>(peak) + side; k >= 0 && k < static_cast<std::ptrdiff_t>(level.size());
       k += side) {
    if (level[k] > level[peak]) break;
    least = std::min(least, level[k]);
  }
  return least;
}

/// How far from the peak the level has fallen to `limit`; nothing where it rises by half a dB before.
std::optional<double> crossing(const std::vector<double>& frequency, const std::vector<double>& level, std::size_t peak,
                               int side, double limit) {
  double least = level[peak];
  for (auto k = static_cast<std::ptrdiff_t>(peak) + side; k >= 0 && k < static_cast<std::ptrdiff_t>(level.size());
       k += side) {
    if (level[k] <= limit) {
      const auto before = k - side;
      const double share = (level[before] - limit) / (level[before] - level[k]);
      return frequency[before] + share * (frequency[k] - frequency[before]);
    }
    if (level[k] > least + 0.5) return std::nullopt;
    least = std::min(least, level[k]);
  }
  return std::nullopt;
}

void find_peaks(const std::vector<double>& frequency, const std::vector<double>& level, double prominence, double decay,
                bool peaks, std::vector<Resonance>& found) {
  for (std::size_t k = 1; k + 1 < level.size(); ++k) {
    if (!(level[k] > level[k - 1] && level[k] >= level[k + 1])) continue;
    const double height = level[k] - std::max(foot(level, k, -1), foot(level, k, 1));
    if (height < prominence) continue;
    const double a = level[k - 1], b = level[k], c = level[k + 1], bend = a - 2 * b + c;
    const double shift = bend < 0 ? 0.5 * (a - c) / bend : 0;
    const double top = b - 0.25 * (a - c) * shift;
    Resonance one;
    one.peak = peaks;
    one.frequency = frequency[k] + shift * (frequency[k + 1] - frequency[k]);
    one.amplitude = std::pow(10.0, (peaks ? top : -top) / 20);
    one.prominence = height;
    const auto low = crossing(frequency, level, k, -1, top - half_power),
               high = crossing(frequency, level, k, 1, top - half_power);
    if (low && high) one.damping = (*high - *low) / (2 * one.frequency) - decay / (2 * M_PI * one.frequency);
    found.push_back(one);
  }
}

}  // namespace

std::vector<Resonance> find_resonances(const std::vector<double>& frequency, const std::vector<Complex>& value,
                                       double prominence, double decay) {
  std::vector<double> level(value.size());
  for (std::size_t k = 0; k < value.size(); ++k) level[k] = 20 * std::log10(std::max(std::abs(value[k]), 1e-300));
  std::vector<Resonance> found;
  find_peaks(frequency, level, prominence, decay, true, found);
  for (double& one : level) one = -one;
  find_peaks(frequency, level, prominence, decay, false, found);
  std::sort(found.begin(), found.end(),
            [](const Resonance& a, const Resonance& b) { return a.frequency < b.frequency; });
  return found;
}

}  // namespace railwave
