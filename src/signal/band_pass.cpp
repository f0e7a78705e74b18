#include "signal/band_pass.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "case/error.hpp"
#include "signal/fourier.hpp"

namespace railwave {
namespace {}  // namespace

double band_gain(const Band& band, double frequency) {
  if (band.low <= 0 && band.high <= 0) return 1;
  double q = 0;
  if (band.low <= 0) {
    q = frequency / band.high;
  } else {
    if (frequency == 0) return 0;
    q = band.high <= 0 ? band.low / frequency
                       : (frequency * frequency - band.low * band.high) / (frequency * (band.high - band.low));
  }
  return 1 / (1 + std::pow(std::fabs(q), 2 * band.order));
}

std::vector<double> band_passed(const std::vector<double>& values, double interval, const Band& band) {
  const double highest = 0.5 / interval;
  if (band.low < 0 || band.high < 0 || (band.high > 0 && band.low >= band.high) ||
      std::max(band.low, band.high) >= highest || band.order < 1 || band.order > 20)
    throw InputError(
        fmt::format("a band from {:.6g} Hz to {:.6g} Hz of order {}: wanted are edges that ascend, below {:.6g} Hz "
                    "(half the sampling frequency), and an order of 1 to 20",
                    band.low, band.high, band.order, highest));
  if (values.size() < 2) return values;
  const double slowest = band.low > 0 ? band.low : band.high > 0 ? band.high : highest;
  const std::size_t count = values.size();
  const std::size_t margin = std::min(count - 1, static_cast<std::size_t>(std::ceil(2 / (slowest * interval))) + 1);
  const std::size_t length = quick_length(count + 2 * margin);
  std::vector<double> longer(length);
  std::copy(values.begin(), values.end(), longer.begin() + static_cast<std::ptrdiff_t>(margin));
  for (std::size_t n = 1; n <= margin; ++n) {
    const double fade = 0.5 * (1 + std::cos(M_PI * static_cast<double>(n) / static_cast<double>(margin + 1)));
    longer[margin - n] = fade * (2 * values.front() - values[n]);
    longer[margin + count - 1 + n] = fade * (2 * values.back() - values[count - 1 - n]);
  }
  auto spectrum = real_spectrum(longer);
  const auto frequency = spectrum_frequencies(length, interval);
  for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= band_gain(band, frequency[k]);
  longer = real_values(spectrum, length);
  return {longer.begin() + static_cast<std::ptrdiff_t>(margin),
          longer.begin() + static_cast<std::ptrdiff_t>(margin + count)};
}

std::vector<Complex> analytic_signal(const std::vector<double>& values) {
  const std::size_t length = values.size();
  const auto half = real_spectrum(values);
  std::vector<Complex> whole(length);
  for (std::size_t k = 0; k < half.size(); ++k) whole[k] = (k == 0 || 2 * k == length ? 1.0 : 2.0) * half[k];
  return values_of(whole);
}

}  // namespace railwave
