#include "signal/decay_rate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace railwave {
namespace {

/// 10 log10(e): of energy that falls as exp(-2 b x) the rate is 8.686 b dB/m, and its integral over the first value
/// 1/(2 b).
const double rate_of_inverse_length = 10 / std::log(10.0);

/// Lengths that stand for the places, m.
std::vector<double> shares(const std::vector<PlacedResponse>& places) {
  const std::size_t last = places.size() - 1;
  std::vector<double> share(places.size());
  for (std::size_t n = 0; n <= last; ++n) {
    if (n > 0 && !(places[n].distance > places[n - 1].distance))
      throw std::logic_error("distances of a decay rate do not ascend");
    const double before = n > 0 ? places[n].distance - places[n - 1].distance : 0;
    const double behind = n < last ? places[n + 1].distance - places[n].distance : before;
    share[n] = 0.5 * (before + behind);
  }
  return share;
}

double energy(const std::vector<double>& frequency, const std::vector<Complex>& value, const ThirdOctave& band) {
  double sum = 0;
  for (std::size_t k = 0; k < frequency.size(); ++k)
    if (frequency[k] >= band.low && frequency[k] < band.high) sum += std::norm(value[k]);
  return sum;
}

}  // namespace

std::vector<ThirdOctave> third_octaves(double from, double to) {
  constexpr double nominal[10] = {1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8};
  std::vector<ThirdOctave> bands;
  for (int k = -30; k <= 30; ++k) {
    ThirdOctave band;
    const int digit = ((k % 10) + 10) % 10;
    band.nominal = nominal[digit] * std::pow(10.0, 3 + (k - digit) / 10);
    band.centre = 1000 * std::pow(10.0, k / 10.0);
    band.low = band.centre * std::pow(10.0, -0.05);
    band.high = band.centre * std::pow(10.0, 0.05);
    if (band.low >= from * (1 - 1e-9) && band.high <= to * (1 + 1e-9)) bands.push_back(band);
  }
  return bands;
}

std::vector<BandDecay> decay_rates(const std::vector<double>& frequency, const std::vector<PlacedResponse>& places,
                                   const std::vector<ThirdOctave>& bands) {
  if (places.size() < 2) throw std::logic_error("a decay rate needs two places");
  const auto share = shares(places);
  std::vector<BandDecay> rates;
  for (const ThirdOctave& band : bands) {
    BandDecay one;
    one.band = band;
    one.least = rate_of_inverse_length / places.back().distance;
    const double first = energy(frequency, places.front().value, band);
    double length = 0;
    for (std::size_t n = 0; n < places.size(); ++n) {
      const double over = energy(frequency, places[n].value, band) / first;
      length += over * share[n];
      one.level.push_back(10 * std::log10(std::max(over, 1e-30)));
    }
    one.rate = rate_of_inverse_length / length;
    rates.push_back(one);
  }
  return rates;
}

}  // namespace railwave
