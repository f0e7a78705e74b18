#pragma once

#include "signal/fourier.hpp"

namespace railwave {

/// Morlet's wavelet pi^(-1/4) exp(i w0 t/s) exp(-(t/s)^2 / 2) at scales s_j = s_0 2^(j spacing), by Torrence and Compo
/// 1998. Their equations are named below.
struct WaveletOptions {
  double w0 = 6;           ///< non-dimensional frequency of the wavelet
  double spacing = 0.125;  ///< of scales, octaves
  double low =
      0;  ///< Hz; 0: the lowest of which the record holds one period and the cone of influence leaves something
  double high = 0;  ///< Hz; 0: a quarter of the sampling frequency
};

/// s of period 1, eq. in their table 1: 4 pi / (w0 + sqrt(2 + w0^2)).
double wavelet_period_of_scale(double w0);

/// Their C_delta of the series' reconstruction (eq. 11, 13), by its integral: 0.778 of w0 = 6, where their table 2 has
/// 0.776.
double wavelet_reconstruction_factor(double w0);

/// The factor in C_delta's place that makes the sum over scales of |W|^2 / s the variance (eq. 14, 24): 0.766 of w0
/// = 6. They use C_delta there too, 1.3 % more.
double wavelet_power_factor(double w0);

/// What the transform gives of N values at `interval`.
struct Wavelet {
  std::vector<double> scale;      ///< s, ascending
  std::vector<double> period;     ///< s
  std::vector<double> frequency;  ///< Hz, 1/period
  std::vector<std::vector<Complex>>
      transform;             ///< W_n(s), eq. 4 with eq. 6: [scale][n], of the values as they are given
  std::vector<double> cone;  ///< [n]: longest period, s, that the record's ends do not reach (their table 1: sqrt(2) s)
  double interval = 0, spacing = 0, w0 = 6;

  double power(std::size_t j, std::size_t n) const { return std::norm(transform[j][n]); }

  /// Mean over time of the power at each scale, eq. 22.
  std::vector<double> global_power() const;
  /// The same over the times that lie inside the cone of influence; NaN where there are none.
  std::vector<double> global_power_in_cone() const;
  /// Power by time in the band from `low` to `high` Hz, in the signal's units squared (eq. 24 with the factor above):
  /// its mean is the mean square of that band.
  std::vector<double> band_power(double low, double high) const;
  /// The series brought back from the transform, eq. 11.
  std::vector<double> reconstructed() const;
};

/// Throws InputError for a band that has no scale, or that the record or its sampling does not reach.
Wavelet wavelet_transform(const std::vector<double>& values, double interval, const WaveletOptions& options);

/// Correlation of neighbouring values of a signal without its mean, which makes the red noise that it is held against;
/// below 0 counts as 0.
double lag_one(const std::vector<double>& values);

/// Power at each scale that red noise of the same variance and lag-1 correlation exceeds at 5 % of the times (Torrence
/// and Compo 1998, eqs. 16 and 18).
std::vector<double> red_noise_power(const Wavelet& wavelet, double variance, double correlation);

}  // namespace railwave
