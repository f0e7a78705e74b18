#include "signal/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace railwave {
namespace {

/// Integral of values exp(-s t) at s = decay + i w, by the trapezoidal rule.
std::vector<Complex> transform(std::vector<double> values, double interval, std::size_t length, double decay) {
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] *= interval * std::exp(-decay * interval * static_cast<double>(i));
  values.front() *= 0.5;
  values.back() *= 0.5;
  return real_spectrum(values, length);
}

/// The cubic through displacement and velocity at both ends of the record, from 0: u = a t + b t^2 + c t^3.
struct Trend {
  double a = 0, b = 0, c = 0, duration = 0;

  Trend(double end, double first_velocity, double last_velocity, double over) : a(first_velocity), duration(over) {
    b = 3 * end / (over * over) - (2 * first_velocity + last_velocity) / over;
    c = -2 * end / (over * over * over) + (first_velocity + last_velocity) / (over * over);
  }
  double at(double t) const { return t * (a + t * (b + t * c)); }
  /// Integral of its acceleration times exp(-s t).
  Complex acceleration(Complex s) const {
    if (std::abs(s) * duration < 1e-9) return 2 * b * duration + 3 * c * duration * duration;
    const Complex end = std::exp(-s * duration), whole = (1.0 - end) / s;
    return 2 * b * whole + 6 * c * (whole - duration * end) / s;
  }
};

std::vector<Complex> acceleration(const Blow& blow, double interval, std::size_t length, double decay) {
  std::vector<double> rest = blow.displacement;
  const double start = rest.front();
  const Trend trend(rest.back() - start, blow.first_velocity, blow.last_velocity,
                    interval * static_cast<double>(rest.size() - 1));
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= start + trend.at(interval * static_cast<double>(i));
  std::vector<Complex> result = transform(std::move(rest), interval, length, decay);
  const auto frequency = spectrum_frequencies(length, interval);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const Complex s(decay, 2 * M_PI * frequency[k]);
    result[k] = s * s * result[k] + trend.acceleration(s);
  }
  return result;
}

}  // namespace

FrequencyResponse frequency_response(const std::vector<Blow>& blows, double interval, std::size_t length,
                                     double decay) {
  if (blows.empty()) throw std::logic_error("a frequency response needs a blow");
  FrequencyResponse result;
  result.frequency = spectrum_frequencies(length, interval);
  const std::size_t count = result.frequency.size();
  std::vector<Complex> cross(count);
  std::vector<double> input(count), output(count);
  for (const Blow& blow : blows) {
    if (blow.force.size() != blow.displacement.size() || blow.force.empty())
      throw std::logic_error("force and displacement of a blow have different lengths");
    const auto force = transform(blow.force, interval, length, decay),
               response = acceleration(blow, interval, length, decay);
    for (std::size_t k = 0; k < count; ++k) {
      cross[k] += std::conj(force[k]) * response[k];
      input[k] += std::norm(force[k]);
      output[k] += std::norm(response[k]);
    }
  }
  result.value.resize(count);
  result.coherence.assign(count, 1);
  result.force.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (input[k] > 0) result.value[k] = cross[k] / input[k];
    const double power = input[k] * output[k];
    if (blows.size() > 1) result.coherence[k] = power > 0 ? std::min(1.0, std::norm(cross[k]) / power) : 0;
    result.force[k] = std::sqrt(input[k] / static_cast<double>(blows.size()));
  }
  return result;
}

void integrate(FrequencyResponse& response, int times, double decay) {
  for (std::size_t k = 0; k < response.value.size(); ++k) {
    const Complex s(decay, 2 * M_PI * response.frequency[k]);
    for (int n = 0; n < times; ++n) response.value[k] = std::abs(s) > 0 ? response.value[k] / s : Complex(0);
  }
}

double force_limit(const FrequencyResponse& response, double decibels) {
  const double least = response.force.front() * std::pow(10.0, -decibels / 20);
  for (std::size_t k = 0; k < response.force.size(); ++k)
    if (response.force[k] < least) return response.frequency[k];
  return response.frequency.back();
}

}  // namespace railwave
