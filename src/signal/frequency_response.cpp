#include "signal/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace railwave {
namespace {

/// Integral of values exp(-s t) at s = decay + i w, by the trapezoidal rule.
std::vector<Complex> transform(std::vector<double> values, double interval, std::size_t length, double decay) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= interval * std::exp(-decay * interval * static_cast<double>(i));
  values.front() *= 0.5;
  values.back() *= 0.5;
  return real_spectrum(values, length);
}

std::vector<Complex> acceleration(const Blow& blow, double interval, std::size_t length, double decay) {
  std::vector<double> moved = blow.displacement;
  const double start = moved.front(), duration = interval * static_cast<double>(moved.size() - 1);
  for (double& one : moved) one -= start;
  const double end = moved.back();
  std::vector<Complex> result = transform(std::move(moved), interval, length, decay);
  const auto frequency = spectrum_frequencies(length, interval);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const Complex s(decay, 2 * M_PI * frequency[k]);
    result[k] = s * s * result[k] + (blow.last_velocity + s * end) * std::exp(-s * duration) - blow.first_velocity;
  }
  return result;
}

}  // namespace

FrequencyResponse frequency_response(const std::vector<Blow>& blows, double interval, std::size_t length, double decay) {
  if (blows.empty()) throw std::logic_error("a frequency response needs a blow");
  FrequencyResponse result;
  result.frequency = spectrum_frequencies(length, interval);
  const std::size_t count = result.frequency.size();
  std::vector<Complex> cross(count);
  std::vector<double> input(count), output(count);
  for (const Blow& blow : blows) {
    if (blow.force.size() != blow.displacement.size() || blow.force.empty()) throw std::logic_error("force and displacement of a blow have different lengths");
    const auto force = transform(blow.force, interval, length, decay), response = acceleration(blow, interval, length, decay);
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
