#include "signal/frequency_response.hpp"

#include <cmath>
#include <stdexcept>

namespace railwave {
namespace {

std::vector<Complex> windowed_spectrum(const std::vector<double>& values, double interval, std::size_t length, double decay) {
  if (decay == 0) return real_spectrum(values, length);
  std::vector<double> weighted(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) weighted[i] = values[i] * std::exp(-decay * interval * static_cast<double>(i));
  return real_spectrum(weighted, length);
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
    if (blow.force.size() != blow.response.size()) throw std::logic_error("force and response of a blow have different lengths");
    const auto force = windowed_spectrum(blow.force, interval, length, decay), response = windowed_spectrum(blow.response, interval, length, decay);
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
    result.force[k] = interval * std::sqrt(input[k] / static_cast<double>(blows.size()));
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
