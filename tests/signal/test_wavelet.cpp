// The wavelet transform on signals whose answer is known, and against what PyWavelets made of the same signal.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "case/error.hpp"
#include "signal/wavelet.hpp"
#include "source_folder.hpp"
#include "tests/signal/made_up_signals.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double interval = 1e-3;

double variance(const std::vector<double>& values) {
  double mean = 0, square = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) square += (value - mean) * (value - mean) / static_cast<double>(values.size());
  return square;
}

/// Mean over the middle three quarters.
double middle_mean(const std::vector<double>& values) {
  double sum = 0;
  const std::size_t margin = values.size() / 8;
  for (std::size_t n = margin; n < values.size() - margin; ++n) sum += values[n];
  return sum / static_cast<double>(values.size() - 2 * margin);
}

}  // namespace

TEST_CASE("a sine's power is largest at its period, and as high as theory has it") {
  const double w0 = GENERATE(6.0, 10.0), frequency = GENERATE(5.0, 23.4);
  const double amplitude = 2.5;
  WaveletOptions options;
  options.w0 = w0;
  options.spacing = 1.0 / 64;
  options.low = 2;
  options.high = 100;
  const auto wavelet = wavelet_transform(made_up::cosine(4096, interval, amplitude, frequency, 0.7), interval, options);
  const auto power = wavelet.global_power_in_cone();
  const std::size_t peak =
      std::max_element(power.begin(), power.end(), [](double a, double b) { return a < b || std::isnan(a); }) -
      power.begin();
  CHECK_THAT(wavelet.frequency[peak], WithinRel(frequency, 0.01));
  // |W|^2 = A^2 sqrt(pi) s / (2 interval) exp(-(s w - w0)^2) of a wave A cos(w t) at each scale.
  for (const std::size_t j : {peak - 20, peak, peak + 20}) {
    const double s = wavelet.scale[j], off = s * 2 * M_PI * frequency - w0;
    // In the middle, which the ends do not reach: on the cone's edge they still take a part of the power.
    CHECK_THAT(wavelet.power(j, 2048),
               WithinRel(amplitude * amplitude * std::sqrt(M_PI) * s / (2 * interval) * std::exp(-off * off), 0.01));
  }
}

TEST_CASE("factors of reconstruction and power") {
  CHECK_THAT(wavelet_reconstruction_factor(6), WithinRel(0.776, 0.01));  // table 2 of Torrence and Compo
  CHECK_THAT(wavelet_period_of_scale(6), WithinRel(1.033, 1e-3));        // p. 67 there: 1.03 s
}

TEST_CASE("the series comes back from its transform, and the power's sum is its variance") {
  // Noise within the band of the scales, so that nothing of it is left out.
  std::vector<double> values(4096);
  for (int i = 0; i < 40; ++i) {
    const auto line = made_up::cosine(values.size(), interval, 1 + 0.1 * (i % 7), 10 + 2.3 * i, 1.7 * i * i);
    for (std::size_t n = 0; n < values.size(); ++n) values[n] += line[n];
  }
  WaveletOptions options;
  options.spacing = 1.0 / 16;
  options.low = 3;
  options.high = 300;
  const auto wavelet = wavelet_transform(values, interval, options);
  const auto back = wavelet.reconstructed();
  double error = 0, size = 0;
  for (std::size_t n = 512; n < values.size() - 512; ++n) {
    error += (back[n] - values[n]) * (back[n] - values[n]);
    size += values[n] * values[n];
  }
  CHECK(std::sqrt(error / size) < 0.01);
  std::vector<double> squares;
  for (const double value : values) squares.push_back(value * value);
  CHECK_THAT(middle_mean(wavelet.band_power(0, 1000)), WithinRel(middle_mean(squares), 0.01));
}

TEST_CASE(
    "white noise has the same mean power at every scale, its variance, and exceeds its level at one time in twenty") {
  const auto values = made_up::noise(200000, 1.5, 31);
  const double square = variance(values);
  CHECK_THAT(lag_one(values), WithinAbs(0, 0.01));
  WaveletOptions options;
  options.spacing = 0.5;
  options.low = 40;
  options.high = 200;
  const auto wavelet = wavelet_transform(values, interval, options);
  const auto level = red_noise_power(wavelet, square, 0);
  double above = 0, ratio = 0;
  const auto mean = wavelet.global_power();
  for (std::size_t j = 0; j < level.size(); ++j) {
    for (std::size_t n = 0; n < values.size(); ++n) above += wavelet.power(j, n) > level[j] ? 1 : 0;
    ratio += mean[j] / square / static_cast<double>(level.size());
  }
  CHECK_THAT(ratio, WithinRel(1.0, 0.01));
  CHECK_THAT(above / static_cast<double>(level.size() * values.size()), WithinRel(0.05, 0.05));
}

TEST_CASE(
    "red noise has the spectrum of its correlation, and its mean power is that spectrum over the width of a wavelet") {
  const double correlation = 0.7;
  auto values = made_up::noise(200000, 1, 31);
  for (std::size_t n = 1; n < values.size(); ++n) values[n] += correlation * values[n - 1];
  CHECK_THAT(lag_one(values), WithinAbs(correlation, 0.007));
  const auto spectrum = [&](double f) {
    double sum = 1;
    for (int lag = 1; lag < 200; ++lag) sum += 2 * std::pow(correlation, lag) * std::cos(2 * M_PI * f * interval * lag);
    return sum;
  };
  WaveletOptions options;
  options.spacing = 0.5;
  options.low = 40;
  options.high = 300;
  const auto wavelet = wavelet_transform(values, interval, options);
  const double square = variance(values);
  const auto level = red_noise_power(wavelet, square, correlation);
  const auto mean = wavelet.global_power();
  for (std::size_t j = 0; j < level.size(); ++j) {
    CHECK_THAT(level[j], WithinRel(2.995732 * square * spectrum(wavelet.frequency[j]), 1e-6));
    double sum = 0, weights = 0;
    for (double f = 1; f < 500; f += 0.5) {
      const double off = wavelet.scale[j] * 2 * M_PI * f - 6, weight = std::exp(-off * off);
      sum += weight * spectrum(f);
      weights += weight;
    }
    CHECK_THAT(mean[j], WithinRel(square * sum / weights, 0.02));
  }
}

TEST_CASE("PyWavelets finds the same modulus") {
  // The formula of data/make_wavelet_reference.py.
  std::vector<double> values(1024);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double t = interval * static_cast<double>(n), from_burst = (t - 0.3) / 0.03;
    values[n] =
        std::cos(2 * M_PI * (5 + 20 * t) * t) + 0.8 * std::exp(-from_burst * from_burst) * std::sin(2 * M_PI * 60 * t);
  }
  std::ifstream file(source_folder + "/tests/signal/data/wavelet_reference.csv");
  REQUIRE(file);
  std::string line;
  std::map<double, std::vector<std::pair<std::size_t, double>>> reference;
  while (std::getline(file, line)) {
    double scale = 0, modulus = 0;
    std::size_t sample = 0;
    char comma = 0;
    if (std::istringstream(line) >> scale >> comma >> sample >> comma >> modulus)
      reference[scale].emplace_back(sample, modulus);
  }
  REQUIRE(reference.size() == 7);
  WaveletOptions options;
  options.spacing = 0.5;
  options.high = 1 / (wavelet_period_of_scale(6) * reference.begin()->first);
  options.low = 0.99 * options.high / 8;
  const auto wavelet = wavelet_transform(values, interval, options);
  REQUIRE(wavelet.scale.size() == reference.size());
  std::size_t j = 0;
  for (const auto& [scale, samples] : reference) {
    CHECK_THAT(wavelet.scale[j], WithinRel(scale, 1e-9));
    double largest = 0, square = 0, theirs = 0;
    for (const auto& [n, modulus] : samples) {
      largest = std::max(largest, modulus);
      square += wavelet.power(j, n);
      theirs += modulus * modulus;
    }
    CHECK_THAT(square, WithinRel(theirs, 0.01));
    for (const auto& [n, modulus] : samples)
      CHECK_THAT(std::sqrt(wavelet.power(j, n)), WithinAbs(modulus, 0.01 * largest));
    ++j;
  }
}

TEST_CASE("bands that cannot be had are refused") {
  const std::vector<double> values(256, 1.0);
  const auto with = [&](double low, double high) {
    WaveletOptions options;
    options.low = low;
    options.high = high;
    return wavelet_transform(values, interval, options);
  };
  CHECK_THROWS_AS(with(200, 100), InputError);
  CHECK_THROWS_AS(with(100, 600), InputError);
  CHECK_THROWS_AS(with(2, 100), InputError);
}
