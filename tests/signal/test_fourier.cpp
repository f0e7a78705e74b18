// Fourier transforms of any length against the sum that defines them, and windows against their known means.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <cmath>
#include <numeric>

#include "case/error.hpp"
#include "signal/fourier.hpp"
#include "signal/window.hpp"
#include "tests/signal/made_up_signals.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("a transform is the sum that defines it, at any length, and its inverse brings the values back") {
  const auto length = GENERATE(std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{60}, std::size_t{64},
                               std::size_t{97}, std::size_t{2 * 211});
  const auto values = made_up::noise(length, 1.0, 7);
  const auto spectrum = real_spectrum(values);
  REQUIRE(spectrum.size() == length / 2 + 1);
  const double tolerance = 1e-12 * static_cast<double>(length);
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    Complex sum = 0;
    for (std::size_t n = 0; n < length; ++n)
      sum += values[n] * std::polar(1.0, -2 * M_PI * static_cast<double>(k * n % length) / static_cast<double>(length));
    CHECK_THAT(std::abs(spectrum[k] - sum), WithinAbs(0, tolerance));
  }
  const auto back = real_values(spectrum, length);
  for (std::size_t n = 0; n < length; ++n) CHECK_THAT(back[n], WithinAbs(values[n], tolerance));
}

TEST_CASE("a long prime length keeps the energy") {
  const std::size_t length = 10007;
  const auto values = made_up::noise(length, 1.0, 3);
  const auto spectrum = real_spectrum(values);
  double energy = std::norm(spectrum[0]);
  for (std::size_t k = 1; k < spectrum.size(); ++k) energy += 2 * std::norm(spectrum[k]);
  const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  CHECK_THAT(energy / static_cast<double>(length), WithinRel(sum, 1e-11));
}

TEST_CASE("lengths without large factors, and the frequencies of a spectrum") {
  CHECK(quick_length(1) == 1);
  CHECK(quick_length(7) == 8);
  CHECK(quick_length(97) == 100);
  CHECK(quick_length(121) == 125);
  const auto frequencies = spectrum_frequencies(8, 1e-3);
  REQUIRE(frequencies.size() == 5);
  CHECK_THAT(frequencies[1], WithinRel(125.0, 1e-12));
  CHECK_THAT(frequencies[4], WithinRel(500.0, 1e-12));
}

TEST_CASE("windows have the mean and the mean square that the books give") {
  const auto mean = [](const std::vector<double>& w, int power) {
    double sum = 0;
    for (const double x : w) sum += std::pow(x, power);
    return sum / static_cast<double>(w.size());
  };
  const auto hann = window(WindowType::hann, 64);
  CHECK_THAT(mean(hann, 1), WithinRel(0.5, 1e-12));
  CHECK_THAT(mean(hann, 2), WithinRel(0.375, 1e-12));
  CHECK_THAT(mean(window(WindowType::hamming, 64), 2), WithinRel(0.3974, 1e-12));
  CHECK_THAT(mean(window(WindowType::flat_top, 64), 1), WithinRel(0.21557895, 1e-9));
  CHECK_THAT(mean(window(WindowType::tukey, 1000, 0.4), 1), WithinRel(0.8, 1e-9));
  const auto exponential = window(WindowType::exponential, 100, 0.01);
  CHECK_THAT(exponential[50], WithinRel(0.1, 1e-12));
  CHECK(mean(window(WindowType::rectangular, 5), 1) == 1);
}

TEST_CASE("a window of another name is refused") {
  CHECK(window_named("tukey") == WindowType::tukey);
  CHECK_THROWS_MATCHES(
      window_named("han"), InputError,
      Catch::Matchers::MessageMatches(ContainsSubstring("there is no window 'han'; did you mean 'hann'?")));
}
