#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

/// Discrete Fourier transforms of any length N: X_k = sum over n of x_n exp(-2 pi i k n / N), without a factor; the
/// inverse has the factor 1/N. A length with a large prime factor takes about six times as long as one of small
/// factors.
namespace railwave {

using Complex = std::complex<double>;

/// X_k of k = 0 ... N-1. Empty for none.
std::vector<Complex> spectrum_of(const std::vector<Complex>& values);

/// x_n of all N of X_k.
std::vector<Complex> values_of(const std::vector<Complex>& spectrum);

/// X_k of k = 0 ... N/2 (rounded down) of real values; the others are the conjugates X_(N-k).
/// @param length N; zeros follow where it is more than there are values; 0: as many as there are
std::vector<Complex> real_spectrum(const std::vector<double>& values, std::size_t length = 0);

/// The `length` real values of the N/2 + 1 of real_spectrum(). Throws std::logic_error for another number of them.
std::vector<double> real_values(const std::vector<Complex>& half_spectrum, std::size_t length);

/// Frequencies of real_spectrum(), Hz: k / (N interval), `interval` in s.
std::vector<double> spectrum_frequencies(std::size_t length, double interval);

/// The smallest number of at least `length` without prime factors above 5.
std::size_t quick_length(std::size_t length);

}  // namespace railwave
