#include "signal/wave_speed.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "case/error.hpp"
#include "signal/fourier.hpp"

namespace railwave {
namespace {

constexpr std::size_t finer = 8;  // interpolation of correlations; wave numbers between two that the row can tell apart

double energy(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// Where between -1/2 and 1/2 the parabola through three equally spaced values has its highest point, and its height
/// there.
struct Peak {
  double place, height;
};
Peak parabola_peak(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  const double place = bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
  return {place, at - 0.25 * (before - after) * place};
}

/// Correlation of two signals by the lag of the second, `finer` values a sample, in a circle of twice the signals'
/// length.
std::vector<double> correlation(const std::vector<Complex>& first, const std::vector<Complex>& second,
                                std::size_t length) {
  // More frequencies without power are values between the samples.
  std::vector<Complex> product(finer * length / 2 + 1);
  for (std::size_t k = 0; k <= (length - 1) / 2; ++k)
    product[k] = std::conj(first[k]) * second[k] * static_cast<double>(finer);
  return real_values(product, finer * length);
}

/// The top that is reached uphill from `at`: lag in samples and height.
Peak top_from(const std::vector<double>& values, std::size_t at) {
  const std::size_t n = values.size();
  while (true) {
    const double before = values[(at + n - 1) % n], after = values[(at + 1) % n];
    if (std::max(before, after) <= values[at]) break;
    at = before > after ? (at + n - 1) % n : (at + 1) % n;
  }
  const Peak peak = parabola_peak(values[(at + n - 1) % n], values[at], values[(at + 1) % n]);
  const double lag = static_cast<double>(at) + peak.place;
  return {(lag > static_cast<double>(n) / 2 ? lag - static_cast<double>(n) : lag) / static_cast<double>(finer),
          peak.height};
}

}  // namespace

TimeOfFlight time_of_flight(const std::vector<std::vector<double>>& signals, const std::vector<double>& distance,
                            double interval) {
  const std::size_t count = signals.size();
  if (count < 2) throw InputError("a wave speed needs two probes at least");
  const std::size_t length = quick_length(2 * signals.front().size());
  std::vector<std::vector<Complex>> spectra;
  for (const auto& signal : signals) spectra.push_back(real_spectrum(signal, length));
  TimeOfFlight flight;
  double lag = 0;  // samples, behind the first
  for (std::size_t p = 0; p < count; ++p) {
    const double norm = std::sqrt(energy(signals.front()) * energy(signals[p]));
    if (!(norm > 0))
      throw InputError(fmt::format("probe {} of the row does not move", energy(signals[p]) > 0 ? 1 : p + 1));
    // From one probe to the next the highest top is the right one; from the first it may be a period off.
    const auto step = correlation(spectra[p > 0 ? p - 1 : 0], spectra[p], length);
    lag += top_from(step, static_cast<std::size_t>(std::max_element(step.begin(), step.end()) - step.begin())).place;
    const auto whole = correlation(spectra.front(), spectra[p], length);
    const auto n = static_cast<long>(whole.size());
    const Peak top =
        top_from(whole, static_cast<std::size_t>(((std::lround(lag * static_cast<double>(finer)) % n) + n) % n));
    lag = top.place;
    flight.lag.push_back(lag * interval);
    flight.similarity.push_back(top.height / norm);
  }
  // Straight line through lags over distances: its slope is one over the speed.
  double mean_x = 0, mean_t = 0, xx = 0, xt = 0, rest = 0;
  for (std::size_t p = 0; p < count; ++p) {
    mean_x += distance[p] / static_cast<double>(count);
    mean_t += flight.lag[p] / static_cast<double>(count);
  }
  for (std::size_t p = 0; p < count; ++p) {
    xx += (distance[p] - mean_x) * (distance[p] - mean_x);
    xt += (distance[p] - mean_x) * (flight.lag[p] - mean_t);
  }
  if (!(xx > 0)) throw InputError("all probes of the row are at the same place");
  const double slowness = xt / xx;
  if (!(std::fabs(slowness) * std::sqrt(xx) > 1e-9 * interval))
    throw InputError("the probes move at the same time: nothing travels along the row");
  for (std::size_t p = 0; p < count; ++p) {
    const double off = flight.lag[p] - mean_t - slowness * (distance[p] - mean_x);
    rest += off * off;
  }
  flight.speed = 1 / slowness;
  flight.scatter = std::sqrt(rest / static_cast<double>(count));
  flight.standard_error = count > 2 ? std::sqrt(rest / static_cast<double>(count - 2) / xx) / (slowness * slowness) : 0;
  return flight;
}

FrequencyWavenumber frequency_wavenumber(const std::vector<std::vector<double>>& signals,
                                         const std::vector<double>& distance, double interval, double low,
                                         double high) {
  const std::size_t probes = signals.size();
  if (probes < 4) throw InputError("frequencies and wave numbers need four probes at least");
  const auto [nearest, farthest] = std::minmax_element(distance.begin(), distance.end());
  const double reach = *farthest - *nearest;
  if (!(reach > 0)) throw InputError("all probes of the row are at the same place");
  const std::size_t length = quick_length(2 * signals.front().size());
  const auto frequency = spectrum_frequencies(length, interval);
  std::vector<std::vector<Complex>> spectra;
  for (const auto& signal : signals) spectra.push_back(real_spectrum(signal, length));

  FrequencyWavenumber result;
  const double limit = 0.5 * static_cast<double>(probes - 1) / reach;
  const auto half = static_cast<int>(finer * probes / 2);
  for (int i = -half; i <= half; ++i) result.wavenumber.push_back(limit * i / half);
  std::vector<std::vector<Complex>> turn(result.wavenumber.size(), std::vector<Complex>(probes));
  for (std::size_t i = 0; i < turn.size(); ++i)
    for (std::size_t p = 0; p < probes; ++p) {
      // Hann's window, a step beyond the row at either end so that the last probes count.
      const double along =
          ((distance[p] - *nearest) / reach * static_cast<double>(probes - 1) + 1) / static_cast<double>(probes + 1);
      turn[i][p] =
          std::polar(std::pow(std::sin(M_PI * along), 2), 2 * M_PI * result.wavenumber[i] * (distance[p] - *nearest));
    }

  double largest = 0;
  for (std::size_t k = 1; k < frequency.size(); ++k) {
    if (frequency[k] < low || (high > 0 && frequency[k] > high)) continue;
    std::vector<double> row(turn.size());
    for (std::size_t i = 0; i < turn.size(); ++i) {
      Complex sum = 0;
      for (std::size_t p = 0; p < probes; ++p) sum += spectra[p][k] * turn[i][p];
      row[i] = std::norm(sum);
    }
    largest = std::max(largest, *std::max_element(row.begin(), row.end()));
    result.frequency.push_back(frequency[k]);
    result.power.push_back(std::move(row));
  }
  if (!(largest > 0))
    throw InputError("the band holds no frequency of the row's motion; choose others by --low and --high");

  double weights = 0, kk = 0, fk = 0;
  const double step = result.wavenumber[1] - result.wavenumber[0];
  for (std::size_t j = 0; j < result.power.size(); ++j) {
    auto& row = result.power[j];
    for (double& power : row) power /= largest;
    const std::size_t at = std::max_element(row.begin() + 1, row.end() - 1) - row.begin();
    // The logarithm of a window's peak is nearly a parabola.
    const double least = 1e-300;
    const Peak peak =
        parabola_peak(std::log(row[at - 1] + least), std::log(row[at] + least), std::log(row[at + 1] + least));
    result.ridge.push_back(result.wavenumber[at] + peak.place * step);
    result.ridge_power.push_back(row[at]);
    if (row[at] < 0.01) continue;
    weights += row[at];
    kk += row[at] * result.ridge[j] * result.ridge[j];
    fk += row[at] * result.ridge[j] * result.frequency[j];
  }
  if (!(std::fabs(fk) > 0)) throw InputError("the probes move at the same time: nothing travels along the row");
  result.speed = fk / kk;
  double rest = 0;
  for (std::size_t j = 0; j < result.ridge.size(); ++j) {
    if (result.ridge_power[j] < 0.01) continue;
    const double off = result.frequency[j] / result.ridge[j] - result.speed;
    rest += result.ridge_power[j] * off * off;
  }
  result.scatter = std::sqrt(rest / weights);
  return result;
}

}  // namespace railwave
