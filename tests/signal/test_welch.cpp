// Power spectra, cross spectra and coherence by Welch's method, on signals whose answer is known.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <algorithm>

#include "case/error.hpp"
#include "signal/welch.hpp"
#include "tests/signal/made_up_signals.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double interval = 1e-4;

/// What the density gives for the band, over the sum of it all.
double mean_over(const std::vector<double>& frequency, const std::vector<double>& values, double low, double high) {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < frequency.size(); ++k)
    if (frequency[k] >= low && frequency[k] <= high) {
      sum += values[k];
      ++count;
    }
  return sum / count;
}

}  // namespace

TEST_CASE("the integral of a sine's density is half its amplitude squared, under any window") {
  const auto type =
      GENERATE(WindowType::rectangular, WindowType::hann, WindowType::hamming, WindowType::flat_top, WindowType::tukey);
  WelchOptions options;
  options.window = type;
  options.segment = 2000;
  const double amplitude = 3;
  // 500 Hz: a hundred periods in a segment. 512.3 Hz: between two frequencies of it.
  for (const double f : {500.0, 512.3}) {
    const auto result = power_density(made_up::cosine(20000, interval, amplitude, f, 0.3), interval, options);
    CHECK(result.segments == 19);
    CHECK_THAT(band_power(result.frequency, result.density, 0, 5000), WithinRel(amplitude * amplitude / 2, 0.01));
    // A narrow window's power is all near the line; the rectangle's leaks far when the line is between two frequencies.
    if (type != WindowType::rectangular && type != WindowType::tukey)
      CHECK_THAT(band_power(result.frequency, result.density, f - 30, f + 30),
                 WithinRel(amplitude * amplitude / 2, 0.01));
    const auto peak = std::max_element(result.density.begin(), result.density.end()) - result.density.begin();
    CHECK_THAT(result.frequency[peak], WithinAbs(f, 2.6));
  }
}

TEST_CASE("white noise has one density, its variance over half the sampling frequency") {
  const double deviation = 2;
  WelchOptions options;
  options.segment = 1024;
  const auto result = power_density(made_up::noise(400000, deviation, 11), interval, options);
  const double level = deviation * deviation / 5000;
  CHECK_THAT(band_power(result.frequency, result.density, 0, 5000), WithinRel(deviation * deviation, 0.01));
  CHECK_THAT(mean_over(result.frequency, result.density, 500, 1500), WithinRel(level, 0.01));
  CHECK_THAT(mean_over(result.frequency, result.density, 3500, 4500), WithinRel(level, 0.01));
}

TEST_CASE("one rectangular segment keeps the energy: Parseval") {
  const auto length = GENERATE(std::size_t{1000}, std::size_t{1001});
  const auto values = made_up::noise(length, 1, 5);
  WelchOptions options;
  options.segment = length;
  options.window = WindowType::rectangular;
  options.trend = Trend::none;
  const auto result = power_density(values, interval, options);
  double sum = 0, square = 0;
  for (const double density : result.density) sum += density * (result.frequency[1] - result.frequency[0]);
  for (const double value : values) square += value * value / static_cast<double>(length);
  CHECK_THAT(sum, WithinRel(square, 1e-12));
}

TEST_CASE("a known coherence and delay between two noises") {
  // b is a, 1.7 ms later, among other noise of such a size that the coherence is 0.64.
  constexpr std::size_t length = 400000, delay = 17;
  const double coherence = 0.64;
  const auto a = made_up::noise(length + delay, 1, 21);
  const auto other = made_up::noise(length, std::sqrt(1 / coherence - 1), 22);
  std::vector<double> first(a.begin() + delay, a.end()), second(length);
  for (std::size_t n = 0; n < length; ++n) second[n] = a[n] + other[n];
  WelchOptions options;
  options.segment = 2048;  // long against the delay, whose share of a segment is lost
  const auto spectra = cross_spectra({first}, {second}, interval, options);
  CHECK_THAT(mean_over(spectra.frequency, spectra.coherence(), 100, 4900), WithinRel(coherence, 0.01));
  // The second comes later: its phase falls by 2 pi f times the delay.
  const auto phase = spectra.phase();
  double fp = 0, ff = 0, previous = 0, turns = 0;
  for (std::size_t k = 0; k < phase.size(); ++k) {
    turns += std::round((previous - phase[k]) / (2 * M_PI) - turns);
    const double unwrapped = phase[k] + 2 * M_PI * turns;
    previous = unwrapped;
    fp += spectra.frequency[k] * unwrapped;
    ff += spectra.frequency[k] * spectra.frequency[k];
  }
  CHECK_THAT(-fp / ff / (2 * M_PI), WithinRel(delay * interval, 0.01));
}

TEST_CASE("the phase of two sines, and coherence over pairs of signals") {
  WelchOptions options;
  options.segment = 4000;
  const auto at = [](const CrossSpectra& spectra, double f) {
    return static_cast<std::size_t>(std::lround(f / spectra.frequency[1]));
  };
  auto spectra = cross_spectra({made_up::cosine(8000, interval, 1, 300, 0)},
                               {made_up::cosine(8000, interval, 2, 300, 1.1)}, interval, options);
  CHECK_THAT(spectra.phase()[at(spectra, 300)], WithinRel(1.1, 1e-6));
  CHECK_THAT(spectra.coherence()[at(spectra, 300)], WithinRel(1.0, 1e-9));

  // Three pairs whose phases differ by a third of a turn have nothing in common: coherence is 0 although each pair is a
  // single line.
  std::vector<std::vector<double>> a, b;
  for (int i = 0; i < 3; ++i) {
    a.push_back(made_up::cosine(4000, interval, 1, 300, 0));
    b.push_back(made_up::cosine(4000, interval, 1, 300, i * 2 * M_PI / 3));
  }
  spectra = cross_spectra(a, b, interval, options);
  CHECK(spectra.segments == 3);
  CHECK(spectra.coherence()[at(spectra, 300)] < 1e-9);
}

TEST_CASE("segments that cannot be cut are refused") {
  WelchOptions options;
  options.segment = 101;
  CHECK_THROWS_AS(power_density(std::vector<double>(100, 0.0), interval, options), InputError);
  options.segment = 10;
  options.overlap = 1;
  CHECK_THROWS_AS(power_density(std::vector<double>(100, 0.0), interval, options), InputError);
}
