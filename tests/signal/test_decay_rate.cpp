#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "signal/decay_rate.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Quarters of a span for two spans, halves up to ten spans, of 0.6 m, then whole ones, as in EN 15461 a grid that gets
/// coarser.
std::vector<double> grid(double longest) {
  std::vector<double> places;
  for (double x = 0; x < longest;) {
    places.push_back(x);
    x += x < 1.2 - 1e-9 ? 0.15 : x < 6 - 1e-9 ? 0.3 : 0.6;
  }
  return places;
}

template <class Wave>
std::vector<PlacedResponse> row(const std::vector<double>& frequency, double longest, const Wave& wave) {
  std::vector<PlacedResponse> places;
  for (double x : grid(longest)) {
    PlacedResponse place{x, {}};
    for (double f : frequency) place.value.push_back(wave(x, f));
    places.push_back(std::move(place));
  }
  return places;
}

std::vector<double> lines(double to) {
  std::vector<double> frequency;
  for (double f = 0; f < to; f += 2) frequency.push_back(f);
  return frequency;
}

}  // namespace

TEST_CASE("third octaves are called by their nominal frequencies and touch each other") {
  const auto bands = third_octaves(88, 6000);
  REQUIRE(bands.size() == 18);
  CHECK(bands.front().nominal == 100);
  CHECK(bands[1].nominal == 125);
  CHECK(bands[9].nominal == 800);
  CHECK(bands[10].nominal == 1000);
  CHECK(bands.back().nominal == 5000);
  CHECK_THAT(bands[5].centre, WithinRel(316.228, 1e-5));
  for (std::size_t k = 1; k < bands.size(); ++k) CHECK_THAT(bands[k].low, WithinRel(bands[k - 1].high, 1e-12));
}

TEST_CASE("the decay rate of a wave that dies away exponentially is its own") {
  // The trapezoids' own error for steps h at first is (2 b h)^2/12: 0.1 % of 2 dB/m, 2.4 % of 10 dB/m.
  const auto frequency = lines(2000);
  for (double rate : {0.5, 1.0, 2.0, 4.0}) {
    const double b = rate / 8.686;
    const auto places = row(
        frequency, 40, [&](double x, double f) { return std::polar(3.0, -2 * M_PI * f * x / 900) * std::exp(-b * x); });
    for (const auto& band : decay_rates(frequency, places, third_octaves(200, 1700)))
      CHECK_THAT(band.rate, WithinRel(rate, 0.01));
  }
}

TEST_CASE("levels along the row and the least rate that it tells") {
  const auto frequency = lines(2000);
  const double b = 5 / 8.686;
  const auto rates =
      decay_rates(frequency, row(frequency, 6.1, [&](double x, double) { return Complex(std::exp(-b * x)); }),
                  third_octaves(446, 563));
  REQUIRE(rates.size() == 1);
  CHECK_THAT(rates[0].least, WithinRel(4.343 / 6, 1e-3));
  CHECK(rates[0].level.front() == 0);
  CHECK_THAT(rates[0].level[8], WithinAbs(-5 * 1.2, 1e-2));
}

TEST_CASE("a beam on an elastic foundation: above its cut-on the decay rate is that of the wave that travels") {
  // E I w'''' + (k (1 + i eta) - m w^2) w = 0, struck at 0: w = -(i exp(-i q x) + exp(-q x)) / (4 E I q^3), q the root
  // with Re > 0, Im < 0.
  constexpr double bending = 4.9e6, mass = 54, foundation = 100e6, loss = 0.25;
  const auto root = [&](double f) {
    const double w = 2 * M_PI * f;
    Complex q = std::pow((mass * w * w - foundation * Complex(1, loss)) / bending, 0.25);
    return q;
  };
  const auto frequency = lines(2400);
  const auto places = row(frequency, 400, [&](double x, double f) {
    const Complex q = root(f);
    const Complex i(0, 1);
    return (i * std::exp(-i * q * x) + std::exp(-q * x)) / (q * q * q);
  });
  for (const auto& band : decay_rates(frequency, places, third_octaves(500, 2300))) {
    const double wave = -8.686 * root(band.band.centre).imag();
    // What the near field adds at the force is in A(x_0): twice the wave's energy there, over a length that is short
    // beside 1/(2 b).
    double exact = 0;
    const Complex q = root(band.band.centre), i(0, 1);
    for (double x = 5e-4; x < 400; x += 1e-3)
      exact += 1e-3 * std::norm((i * std::exp(-i * q * x) + std::exp(-q * x)) / (1.0 + i));
    INFO(band.band.nominal << " Hz: " << band.rate << " dB/m, the wave's own " << wave);
    CHECK_THAT(band.rate, WithinRel(10 / std::log(10.0) / exact, 0.05));
    CHECK(band.rate > wave);
    CHECK(band.rate < 2.2 * wave);
  }
}
