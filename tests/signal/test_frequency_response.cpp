#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "signal/frequency_response.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Mass on spring and dashpot: 60 Hz, 2 % of critical damping.
struct Oscillator {
  double mass = 5, frequency = 60, damping = 0.02;
  double stiffness() const { return mass * std::pow(2 * M_PI * frequency, 2); }
  double dashpot() const { return 2 * damping * mass * 2 * M_PI * frequency; }
  Complex accelerance(Complex s) const { return s * s / (stiffness() + s * (dashpot() + mass * s)); }

  /// A motion u = t^2 exp(-a t), and the force that it takes.
  Blow blow(double a, double interval, std::size_t samples, double offset = 0) const {
    Blow result;
    for (std::size_t i = 0; i < samples; ++i) {
      const double t = interval * static_cast<double>(i), e = std::exp(-a * t);
      const double u = t * t * e, v = (2 * t - a * t * t) * e, w = (2 - 4 * a * t + a * a * t * t) * e;
      result.displacement.push_back(u + offset);
      result.force.push_back(mass * w + dashpot() * v + stiffness() * u);
      result.last_velocity = v;
    }
    return result;
  }
};

constexpr double interval = 2e-5;

}  // namespace

TEST_CASE("acceleration over force of an oscillator is as its equation says, in size and phase") {
  const Oscillator oscillator;
  const double offset = 1e-3;  // as a static load leaves it
  const auto response = frequency_response({oscillator.blow(120, interval, 20000, offset)}, interval, 20000);
  for (std::size_t k = 4; response.frequency[k] < 400; ++k) {
    const Complex exact = oscillator.accelerance({0, 2 * M_PI * response.frequency[k]});
    CHECK(std::abs(response.value[k] - exact) < 2e-3 * std::abs(exact));
    CHECK(response.coherence[k] == 1);
  }
}

TEST_CASE("a record that ends in the middle of the motion is right too") {
  const Oscillator oscillator;
  Blow blow = oscillator.blow(120, interval, 300);
  // A force that ends with the record, and what the acceleration comes to until then.
  const auto response = frequency_response({blow}, interval, 300);
  double acceleration = blow.last_velocity, force = 0;
  for (std::size_t i = 0; i < blow.force.size(); ++i)
    force += interval * (i == 0 || i + 1 == blow.force.size() ? 0.5 : 1.0) * blow.force[i];
  CHECK_THAT(response.value[0].real(), WithinRel(acceleration / force, 1e-12));
}

TEST_CASE("with an exponential window the response is that at a complex frequency, and the damping comes out") {
  const Oscillator oscillator;
  constexpr double decay = 5;
  const auto response = frequency_response({oscillator.blow(120, interval, 20000)}, interval, 200000, decay);
  for (std::size_t k = 40; response.frequency[k] < 400; k += 7) {
    const Complex exact = oscillator.accelerance({decay, 2 * M_PI * response.frequency[k]});
    CHECK(std::abs(response.value[k] - exact) < 2e-3 * std::abs(exact));
  }
  std::vector<double> frequency;
  std::vector<Complex> value;
  for (std::size_t k = 40; response.frequency[k] < 400; ++k)
    frequency.push_back(response.frequency[k]), value.push_back(response.value[k]);
  const auto found = find_resonances(frequency, value, 3, decay);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].frequency, WithinRel(60.0, 0.005));
  CHECK_THAT(*found[0].damping, WithinAbs(0.02, 0.001));
}

TEST_CASE("mobility and receptance are the accelerance over i w, once and twice") {
  const Oscillator oscillator;
  auto response = frequency_response({oscillator.blow(120, interval, 20000)}, interval, 20000);
  const Complex accelerance = response.value[20];
  const Complex s(0, 2 * M_PI * response.frequency[20]);
  auto receptance = response;
  integrate(response, 1);
  integrate(receptance, 2);
  CHECK(std::abs(response.value[20] - accelerance / s) < 1e-12 * std::abs(accelerance));
  CHECK(std::abs(receptance.value[20] - accelerance / (s * s)) < 1e-12 * std::abs(accelerance));
  CHECK(receptance.value[0] == Complex(0));
}

TEST_CASE("of several blows the response is their mean, and the coherence tells how they agree") {
  const Oscillator oscillator;
  Blow one = oscillator.blow(120, interval, 10000), other = one;
  for (double& u : other.displacement) u *= 3;
  other.last_velocity *= 3;
  const auto single = frequency_response({one}, interval, 10000),
             both = frequency_response({one, other}, interval, 10000);
  for (std::size_t k = 5; k < 100; k += 9) {
    CHECK(std::abs(both.value[k] - 2.0 * single.value[k]) < 1e-9 * std::abs(single.value[k]));
    CHECK_THAT(both.coherence[k], WithinAbs(0.8, 1e-9));  // (1 + 3)^2 / (2 (1 + 9))
    CHECK_THAT(both.force[k], WithinRel(single.force[k], 1e-9));
  }
}

TEST_CASE("the spectrum of half a sine wave is 3 dB down at 0.59, 10 dB at 1.02 over its duration") {
  constexpr double duration = 2e-4, fine = 1e-6;
  Blow blow;
  for (int i = 0; i < 100000; ++i) blow.force.push_back(i * fine < duration ? std::sin(M_PI * i * fine / duration) : 0);
  blow.displacement.assign(blow.force.size(), 0);
  const auto response = frequency_response({blow}, fine, 100000);
  CHECK_THAT(force_limit(response, 3), WithinRel(0.59 / duration, 0.01));
  CHECK_THAT(force_limit(response, 10), WithinRel(1.02 / duration, 0.005));
}

TEST_CASE("peaks and troughs are found between the lines, with their damping") {
  // Two oscillators side by side: two peaks, and a trough between them.
  const Oscillator low{1, 200, 0.01}, high{1, 500, 0.005};
  std::vector<double> frequency;
  std::vector<Complex> value;
  for (double f = 20; f < 1000; f += 0.73) {
    frequency.push_back(f);
    const Complex s(0, 2 * M_PI * f);
    value.push_back(low.accelerance(s) + high.accelerance(s));
  }
  const auto found = find_resonances(frequency, value, 3);
  REQUIRE(found.size() == 3);
  CHECK((found[0].peak && !found[1].peak && found[2].peak));
  CHECK_THAT(found[0].frequency, WithinAbs(200, 0.2));
  CHECK_THAT(found[2].frequency, WithinAbs(500, 0.2));
  CHECK_THAT(*found[0].damping, WithinRel(0.01, 0.03));
  CHECK_THAT(*found[2].damping, WithinRel(0.005, 0.03));
  CHECK_THAT(found[0].amplitude, WithinRel(50, 0.02));  // 1 / (2 m damping)
  CHECK((found[1].frequency > 210 && found[1].frequency < 490));
  CHECK(find_resonances(frequency, value, 200).empty());
}
