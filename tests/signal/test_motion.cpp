// Filters, the ellipse of a particle, and the speed of waves along a row of probes, on made-up waves.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "case/error.hpp"
#include "signal/band_pass.hpp"
#include "signal/particle_motion.hpp"
#include "signal/wave_speed.hpp"
#include "tests/signal/made_up_signals.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double interval = 1e-6;

/// Ricker's pulse of the middle frequency `f`, at time t.
double pulse(double t, double f) {
  const double x = M_PI * f * t * M_PI * f * t;
  return (1 - 2 * x) * std::exp(-x);
}

std::vector<std::vector<double>> travelling_pulse(const std::vector<double>& distance, double speed, double f) {
  std::vector<std::vector<double>> signals;
  for (const double x : distance) {
    std::vector<double> signal(600);
    for (std::size_t n = 0; n < signal.size(); ++n)
      signal[n] = pulse(interval * static_cast<double>(n) - 2e-4 - x / speed, f);
    signals.push_back(signal);
  }
  return signals;
}

}  // namespace

TEST_CASE("a band keeps what is in it, without delay, and halves its edges") {
  const double f = GENERATE(2000.0, 10000.0, 20000.0, 40000.0, 200000.0);
  const Band band{10000, 40000, 4};
  const auto wave = made_up::cosine(5000, interval, 1, f, 0.4);
  const auto filtered = band_passed(wave, interval, band);
  const double gain = f == 20000 ? 1 : f == 10000 || f == 40000 ? 0.5 : 0;
  for (std::size_t n = 1000; n < 4000; n += 7)
    CHECK_THAT(filtered[n], WithinAbs(gain * wave[n], f == 2000 || f == 200000 ? 1e-3 : 0.01));
}

TEST_CASE("a low and a high pass are complements of the first order, and edges out of order are refused") {
  CHECK_THAT(band_gain({0, 1000, 2}, 1000), WithinRel(0.5, 1e-12));
  CHECK_THAT(band_gain({1000, 0, 2}, 2000), WithinRel(1 / (1 + 1.0 / 16), 1e-12));
  CHECK_THAT(band_gain({0, 1000, 1}, 300) + band_gain({1000, 0, 1}, 300), WithinRel(1.0, 1e-12));
  CHECK(band_gain({10, 1000, 3}, 0) == 0);
  const std::vector<double> values(100, 1.0);
  CHECK_THROWS_AS(band_passed(values, interval, {2000, 1000, 4}), InputError);
  CHECK_THROWS_AS(band_passed(values, interval, {1000, 500000, 4}), InputError);
  CHECK_THROWS_AS(band_passed(values, interval, {1000, 2000, 0}), InputError);
}

TEST_CASE("a constant stays under a low pass and goes under a band") {
  const std::vector<double> values(2000, 3.0);
  for (const double value : band_passed(values, interval, {0, 50000, 4})) CHECK_THAT(value, WithinAbs(3, 0.02));
  for (std::size_t n = 500; n < 1500; ++n)
    CHECK_THAT(band_passed(values, interval, {20000, 50000, 4})[n], WithinAbs(0, 0.03));
}

TEST_CASE("the ellipse of a particle: axes, tilt, phase and the sense of its rotation") {
  const double f = 5000, turn = GENERATE(0.0, 0.5, -0.4), sense = GENERATE(1.0, -1.0);
  // Long axis upright before it is turned, as in a Rayleigh wave: backwards at the top.
  const auto along = made_up::cosine(4000, interval, 1, f, sense * M_PI / 2),
             up = made_up::cosine(4000, interval, 1.5, f, 0);
  std::vector<double> x(along.size()), z(along.size());
  for (std::size_t n = 0; n < x.size(); ++n) {
    x[n] = std::cos(turn) * along[n] - std::sin(turn) * up[n];
    z[n] = std::sin(turn) * along[n] + std::cos(turn) * up[n];
  }
  const auto motion = particle_motion(x, z);
  CHECK_THAT(motion.semi_axis_major, WithinRel(1.5, 0.01));
  CHECK_THAT(motion.semi_axis_minor, WithinRel(1.0, 0.01));
  CHECK(motion.retrograde() == (sense > 0));
  CHECK_THAT(std::fabs(std::sin(motion.tilt - turn - M_PI / 2)), WithinAbs(0, 0.01));
  CHECK_THAT(motion.polarisation, WithinRel(1.0, 1e-6));
  if (turn == 0) {
    CHECK_THAT(motion.phase, WithinAbs(-sense * M_PI / 2, 0.01));
    CHECK_THAT(motion.amplitude_ratio, WithinRel(1.5, 0.01));
  }
}

TEST_CASE("noise in both components is no ellipse, and rest is refused") {
  const auto motion = particle_motion(made_up::noise(50000, 1, 1), made_up::noise(50000, 1, 2));
  CHECK(motion.polarisation < 0.03);
  CHECK(motion.coherence < 1e-3);
  CHECK_THROWS_AS(particle_motion({0, 0, 0, 0}, {0, 0, 0, 0}), InputError);
}

TEST_CASE("the speed of a pulse along a row, either way, by time of flight and by frequency and wave number") {
  const double speed = GENERATE(2984.0, -5190.0);
  std::vector<double> distance;
  for (int p = 0; p < 24; ++p) distance.push_back(0.01 * p);
  // So that it does not leave the record the pulse comes early when it runs the other way.
  const auto signals = travelling_pulse(distance, speed, 50000);
  const auto flight = time_of_flight(signals, distance, interval);
  CHECK_THAT(flight.speed, WithinRel(speed, 1e-3));
  CHECK(flight.scatter < 0.02 * interval);
  CHECK_THAT(flight.similarity.back(), WithinRel(1.0, 1e-3));
  const auto ridge = frequency_wavenumber(signals, distance, interval, 20000, 100000);
  CHECK_THAT(ridge.speed, WithinRel(speed, 2e-3));
  CHECK(ridge.scatter < 0.01 * std::fabs(speed));
}

TEST_CASE("a wave of a narrow band is not taken a period early or late") {
  // Dispersive: its groups run faster than its phases, so that far along the row another period is the most alike.
  std::vector<double> distance;
  std::vector<std::vector<double>> signals;
  for (int p = 0; p < 24; ++p) {
    distance.push_back(0.01 * p);
    std::vector<double> signal(800);
    for (std::size_t n = 0; n < signal.size(); ++n) {
      const double t = interval * static_cast<double>(n) - 2e-4, group = (t - distance[p] / 4500) / 4e-5;
      signal[n] = std::exp(-group * group) * std::cos(2 * M_PI * 50000 * (t - distance[p] / 3000));
    }
    signals.push_back(signal);
  }
  const auto flight = time_of_flight(signals, distance, interval);
  CHECK_THAT(flight.speed, WithinRel(3000.0, 0.02));
  CHECK(flight.scatter < interval);
}

TEST_CASE("rows that are too short or do not move are refused") {
  const std::vector<double> still(100, 0.0);
  CHECK_THROWS_AS(time_of_flight({still}, {0}, interval), InputError);
  CHECK_THROWS_AS(time_of_flight({still, still}, {0, 1}, interval), InputError);
  const auto noise = made_up::noise(100, 1, 1);
  CHECK_THROWS_AS(time_of_flight({noise, noise}, {0, 1}, interval), InputError);
  CHECK_THROWS_AS(time_of_flight({noise, noise}, {1, 1}, interval), InputError);
  CHECK_THROWS_AS(frequency_wavenumber({noise, noise, noise}, {0, 1, 2}, interval, 0, 0), InputError);
}
