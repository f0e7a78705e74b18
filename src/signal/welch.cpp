#include "signal/welch.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "case/error.hpp"

namespace railwave {
namespace {

constexpr std::size_t shortest = 16;

/// Windowed transforms of the segments of one signal.
template <class Take>
void each_segment(const std::vector<double>& values, const std::vector<double>& weights, std::size_t shift, Trend trend,
                  const Take& take) {
  const std::size_t length = weights.size();
  for (std::size_t begin = 0; begin + length <= values.size(); begin += shift) {
    auto segment = without_trend({values.begin() + static_cast<std::ptrdiff_t>(begin),
                                  values.begin() + static_cast<std::ptrdiff_t>(begin + length)},
                                 trend);
    for (std::size_t n = 0; n < length; ++n) segment[n] *= weights[n];
    take(real_spectrum(segment));
  }
}

}  // namespace

std::size_t segment_length(std::size_t signal_length, const WelchOptions& options) {
  if (options.segment != 0) return options.segment;
  const double eight = static_cast<double>(signal_length) / (1 + 7 * (1 - options.overlap));
  return eight < static_cast<double>(shortest) ? signal_length : static_cast<std::size_t>(eight);
}

CrossSpectra cross_spectra(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                           double interval, const WelchOptions& options) {
  if (a.empty() || a.size() != b.size()) throw std::logic_error("cross spectra need pairs of signals");
  if (!(options.overlap >= 0 && options.overlap < 1))
    throw InputError(fmt::format("an overlap of {} is none: it is 0 or more, and below 1", options.overlap));
  const std::size_t length = segment_length(a.front().size(), options);
  if (length > a.front().size() || length < 2)
    throw InputError(fmt::format("segments of {} samples cannot be cut from signals of {}; choose shorter ones", length,
                                 a.front().size()));
  const auto weights = window(options.window, length, options.window_parameter);
  const std::size_t shift = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(static_cast<double>(length) * (1 - options.overlap))));

  CrossSpectra sums;
  sums.segment_length = length;
  sums.frequency = spectrum_frequencies(length, interval);
  const std::size_t count = sums.frequency.size();
  sums.density_a.assign(count, 0);
  sums.density_b.assign(count, 0);
  sums.cross.assign(count, 0);
  for (std::size_t pair = 0; pair < a.size(); ++pair) {
    if (a[pair].size() != a.front().size() || b[pair].size() != a.front().size())
      throw std::logic_error("signals of a pair have other lengths");
    std::vector<std::vector<Complex>> spectra;
    each_segment(a[pair], weights, shift, options.trend,
                 [&](std::vector<Complex> spectrum) { spectra.push_back(std::move(spectrum)); });
    std::size_t segment = 0;
    each_segment(b[pair], weights, shift, options.trend, [&](const std::vector<Complex>& spectrum) {
      for (std::size_t k = 0; k < count; ++k) {
        sums.density_a[k] += std::norm(spectra[segment][k]);
        sums.density_b[k] += std::norm(spectrum[k]);
        sums.cross[k] += std::conj(spectra[segment][k]) * spectrum[k];
      }
      ++segment;
    });
    sums.segments += segment;
  }
  double square = 0;
  for (const double w : weights) square += w * w;
  for (std::size_t k = 0; k < count; ++k) {
    // The frequencies above half the sampling frequency mirror those below; 0 and the half itself stand alone.
    const double sides = k == 0 || 2 * k == length ? 1 : 2;
    const double factor = sides * interval / (square * static_cast<double>(sums.segments));
    sums.density_a[k] *= factor;
    sums.density_b[k] *= factor;
    sums.cross[k] *= factor;
  }
  return sums;
}

std::vector<double> CrossSpectra::coherence() const {
  std::vector<double> result(cross.size());
  for (std::size_t k = 0; k < cross.size(); ++k) {
    const double product = density_a[k] * density_b[k];
    result[k] = product > 0 ? std::min(1.0, std::norm(cross[k]) / product) : 0;
  }
  return result;
}

std::vector<double> CrossSpectra::phase() const {
  std::vector<double> result(cross.size());
  for (std::size_t k = 0; k < cross.size(); ++k) result[k] = std::arg(cross[k]);
  return result;
}

PowerDensity power_density(const std::vector<double>& values, double interval, const WelchOptions& options) {
  CrossSpectra spectra = cross_spectra({values}, {values}, interval, options);
  return {std::move(spectra.frequency), std::move(spectra.density_a), spectra.segments, spectra.segment_length};
}

double band_power(const std::vector<double>& frequency, const std::vector<double>& density, double low, double high) {
  if (frequency.size() < 2) return 0;
  const double width = frequency[1] - frequency[0];
  double power = 0;
  for (std::size_t k = 0; k < frequency.size(); ++k) {
    const double begin = std::max(low, frequency[k] - width / 2), end = std::min(high, frequency[k] + width / 2);
    if (end > begin) power += density[k] * (end - begin);
  }
  return power;
}

}  // namespace railwave
