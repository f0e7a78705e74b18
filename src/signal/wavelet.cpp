#include "signal/wavelet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "case/error.hpp"
#include "signal/fourier.hpp"

namespace railwave {
namespace {

const double norm = std::pow(M_PI, -0.25);  // of Morlet's wavelet

/// Integral over u > 0 of exp(-(u - w0)^2 width) / u, but for the few that lie below w0/20, where it is no wavelet any
/// more.
double mean_inverse(double w0, double width) {
  const double begin = w0 / 20, end = w0 + 12;
  const int count = 20000;
  const double step = (end - begin) / count;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double u = begin + (i + 0.5) * step;
    sum += std::exp(-(u - w0) * (u - w0) * width) / u * step;
  }
  return sum;
}

}  // namespace

double wavelet_period_of_scale(double w0) { return 4 * M_PI / (w0 + std::sqrt(2 + w0 * w0)); }

double wavelet_reconstruction_factor(double w0) { return std::sqrt(M_PI / 2) / std::log(2.0) * mean_inverse(w0, 0.5); }

double wavelet_power_factor(double w0) { return std::sqrt(M_PI) / std::log(2.0) * mean_inverse(w0, 1); }

Wavelet wavelet_transform(const std::vector<double>& values, double interval, const WaveletOptions& options) {
  const std::size_t count = values.size();
  if (!(options.w0 >= 5 && options.w0 <= 50))
    throw InputError(fmt::format("a wavelet of w0 = {} is of no use here: 5 to 50 is wanted, usually 6", options.w0));
  if (!(options.spacing > 0 && options.spacing <= 1))
    throw InputError(fmt::format("scales {} octaves apart: more than 0 and at most 1 is wanted", options.spacing));
  Wavelet result;
  result.interval = interval;
  result.spacing = options.spacing;
  result.w0 = options.w0;
  const double factor = wavelet_period_of_scale(options.w0), duration = static_cast<double>(count) * interval;
  // In the record's middle the cone leaves periods of up to this.
  const double lowest = options.low > 0 ? options.low : std::sqrt(2.0) / factor / (duration / 2);
  const double highest = options.high > 0 ? options.high : 0.25 / interval;
  if (!(highest > lowest))
    throw InputError(fmt::format("a wavelet's band from {:.6g} Hz to {:.6g} Hz is empty", lowest, highest));
  if (highest > 0.5 / interval)
    throw InputError(fmt::format("samples every {:.6g} s hold nothing above {:.6g} Hz; ask for no more by --high",
                                 interval, 0.5 / interval));
  if (lowest * duration < 1)
    throw InputError(
        fmt::format("a record of {:.6g} s holds no period of {:.6g} Hz; ask for {:.6g} Hz or more by --low", duration,
                    lowest, 1 / duration));

  // Zeros keep the ends from meeting.
  const std::size_t length = quick_length(2 * count);
  const auto spectrum = real_spectrum(values, length);
  const int octaves = static_cast<int>(std::floor(std::log2(highest / lowest) / options.spacing + 1e-9));
  std::vector<Complex> product(length);
  for (int j = 0; j <= octaves; ++j) {
    const double period = std::exp2(j * options.spacing) / highest, scale = period / factor;
    const double size = std::sqrt(2 * M_PI * scale / interval) * norm;
    for (std::size_t k = 0; k < length; ++k) {
      if (k == 0 || k > length / 2) {
        product[k] = 0;
        continue;
      }
      const double w = 2 * M_PI * static_cast<double>(k) / (static_cast<double>(length) * interval),
                   off = scale * w - options.w0;
      product[k] = spectrum[k] * (size * std::exp(-off * off / 2));
    }
    auto transform = values_of(product);
    transform.resize(count);
    result.scale.push_back(scale);
    result.period.push_back(period);
    result.frequency.push_back(1 / period);
    result.transform.push_back(std::move(transform));
  }
  result.cone.resize(count);
  for (std::size_t n = 0; n < count; ++n)
    result.cone[n] = factor / std::sqrt(2.0) * interval * static_cast<double>(std::min(n, count - 1 - n));
  return result;
}

std::vector<double> Wavelet::global_power() const {
  std::vector<double> mean(scale.size());
  for (std::size_t j = 0; j < scale.size(); ++j) {
    for (std::size_t n = 0; n < cone.size(); ++n) mean[j] += power(j, n);
    mean[j] /= static_cast<double>(cone.size());
  }
  return mean;
}

std::vector<double> Wavelet::global_power_in_cone() const {
  std::vector<double> mean(scale.size());
  for (std::size_t j = 0; j < scale.size(); ++j) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < cone.size(); ++n) {
      if (cone[n] < period[j]) continue;
      mean[j] += power(j, n);
      ++count;
    }
    mean[j] = count > 0 ? mean[j] / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }
  return mean;
}

std::vector<double> Wavelet::band_power(double low, double high) const {
  std::vector<double> sum(cone.size());
  const double factor = spacing * interval / wavelet_power_factor(w0);
  for (std::size_t j = 0; j < scale.size(); ++j) {
    if (frequency[j] < low || frequency[j] > high) continue;
    for (std::size_t n = 0; n < cone.size(); ++n) sum[n] += factor * power(j, n) / scale[j];
  }
  return sum;
}

std::vector<double> Wavelet::reconstructed() const {
  std::vector<double> sum(cone.size());
  const double factor = spacing * std::sqrt(interval) / (wavelet_reconstruction_factor(w0) * norm);
  for (std::size_t j = 0; j < scale.size(); ++j)
    for (std::size_t n = 0; n < cone.size(); ++n) sum[n] += factor * transform[j][n].real() / std::sqrt(scale[j]);
  return sum;
}

double lag_one(const std::vector<double>& values) {
  double mean = 0, square = 0, product = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    square += (values[n] - mean) * (values[n] - mean);
    if (n > 0) product += (values[n] - mean) * (values[n - 1] - mean);
  }
  return square > 0 ? std::max(0.0, product / square) : 0;
}

std::vector<double> red_noise_power(const Wavelet& wavelet, double variance, double correlation) {
  constexpr double chi_square = 5.991464547107979;  // of 2 degrees of freedom, exceeded with a probability of 5 %
  std::vector<double> level(wavelet.scale.size());
  for (std::size_t j = 0; j < level.size(); ++j) {
    const double cosine = std::cos(2 * M_PI * wavelet.interval * wavelet.frequency[j]);
    level[j] = variance * (1 - correlation * correlation) / (1 + correlation * correlation - 2 * correlation * cosine) *
               chi_square / 2;
  }
  return level;
}

}  // namespace railwave
