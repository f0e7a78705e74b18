#include "signal/fourier.hpp"

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

#include <stdexcept>

namespace railwave {
namespace {

/// The largest prime factor that is still left to the mixed-radix transform, whose cost goes with it.
constexpr std::size_t largest_factor = 13;

std::size_t without_small_factors(std::size_t length, std::size_t largest) {
  for (std::size_t factor = 2; factor <= largest; ++factor)
    while (length % factor == 0) length /= factor;
  return length;
}

std::vector<Complex> mixed_radix(const std::vector<Complex>& values, bool inverse) {
  Eigen::FFT<double> transform;
  std::vector<Complex> result(values.size());
  if (inverse)
    transform.inv(result.data(), values.data(), static_cast<Eigen::Index>(values.size()));
  else
    transform.fwd(result.data(), values.data(), static_cast<Eigen::Index>(values.size()));
  return result;
}

/// Bluestein: 2 k n = k^2 + n^2 - (k - n)^2 makes of the transform a convolution, which may be of any longer length.
std::vector<Complex> by_convolution(const std::vector<Complex>& values) {
  const std::size_t n = values.size(), length = quick_length(2 * n - 1);
  std::vector<Complex> turn(n), chirped(length), kernel(length);
  for (std::size_t k = 0; k < n; ++k)
    turn[k] = std::polar(1.0, -M_PI * static_cast<double>(k * k % (2 * n)) / static_cast<double>(n));
  for (std::size_t k = 0; k < n; ++k) chirped[k] = values[k] * turn[k];
  for (std::size_t k = 0; k < n; ++k) kernel[k] = kernel[(length - k) % length] = std::conj(turn[k]);
  chirped = mixed_radix(chirped, false);
  kernel = mixed_radix(kernel, false);
  for (std::size_t k = 0; k < length; ++k) chirped[k] *= kernel[k];
  chirped = mixed_radix(chirped, true);
  chirped.resize(n);
  for (std::size_t k = 0; k < n; ++k) chirped[k] *= turn[k];
  return chirped;
}

}  // namespace

std::vector<Complex> spectrum_of(const std::vector<Complex>& values) {
  if (values.size() < 2) return values;  // which Eigen cannot do
  return without_small_factors(values.size(), largest_factor) == 1 ? mixed_radix(values, false)
                                                                   : by_convolution(values);
}

std::vector<Complex> values_of(const std::vector<Complex>& spectrum) {
  // The inverse is the forward transform of the conjugates.
  std::vector<Complex> turned(spectrum.size());
  for (std::size_t k = 0; k < spectrum.size(); ++k) turned[k] = std::conj(spectrum[k]);
  turned = spectrum_of(turned);
  for (Complex& value : turned) value = std::conj(value) / static_cast<double>(spectrum.size());
  return turned;
}

std::vector<Complex> real_spectrum(const std::vector<double>& values, std::size_t length) {
  if (length == 0) length = values.size();
  if (length < values.size()) throw std::logic_error("a transform is shorter than its values");
  std::vector<Complex> padded(values.begin(), values.end());
  padded.resize(length);
  padded = spectrum_of(padded);
  if (length > 0) padded.resize(length / 2 + 1);
  return padded;
}

std::vector<double> real_values(const std::vector<Complex>& half_spectrum, std::size_t length) {
  if (half_spectrum.size() != length / 2 + 1)
    throw std::logic_error("a half spectrum has another length than its values need");
  std::vector<Complex> whole(length);
  for (std::size_t k = 0; k < length; ++k)
    whole[k] = k <= length / 2 ? half_spectrum[k] : std::conj(half_spectrum[length - k]);
  whole = values_of(whole);
  std::vector<double> values(length);
  for (std::size_t n = 0; n < length; ++n) values[n] = whole[n].real();
  return values;
}

std::vector<double> spectrum_frequencies(std::size_t length, double interval) {
  std::vector<double> frequencies(length / 2 + 1);
  for (std::size_t k = 0; k < frequencies.size(); ++k)
    frequencies[k] = static_cast<double>(k) / (static_cast<double>(length) * interval);
  return frequencies;
}

std::size_t quick_length(std::size_t length) {
  if (length == 0) return 1;
  while (without_small_factors(length, 5) != 1) ++length;
  return length;
}

}  // namespace railwave
