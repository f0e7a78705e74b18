// railwave signal wavelet: power by time and frequency.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "case/error.hpp"
#include "post/signal_report.hpp"
#include "signal/wavelet.hpp"

namespace railwave {

SignalReport report_wavelet(const SignalInput& input) {
  const auto channels = input.channels();
  if (channels.size() != 1)
    throw InputError(fmt::format(
        "{} channels are named, a wavelet takes one; --average makes one of what a --channel finds", channels.size()));
  const HistoryChannel& channel = *channels.front();
  const SignalRequest& request = input.request;
  WaveletOptions options;
  options.w0 = request.w0;
  options.spacing = request.scale_spacing;
  options.low = request.low;
  options.high = request.high;
  const Wavelet wavelet = wavelet_transform(channel.values, input.interval(), options);
  const double variance = mean_square(channel.values), correlation = lag_one(channel.values);
  if (!(variance > 0)) throw InputError(fmt::format("channel '{}' does not change: it has no spectrum", channel.name));
  const auto global = wavelet.global_power(), in_cone = wavelet.global_power_in_cone(),
             noise = red_noise_power(wavelet, variance, correlation);
  const std::string power_unit = product_unit(channel.unit, channel.unit);

  Table by_frequency({{"frequency", "Hz"},
                      {"period", "s"},
                      {"scale", "s"},
                      {"global_power", power_unit},
                      {"global_power_in_cone", power_unit},
                      {"red_noise_95", power_unit}});
  SignalReport report;
  SignalReport::Array power{"power", power_unit, {wavelet.scale.size(), input.length()}, {}};
  power.values.reserve(wavelet.scale.size() * input.length());
  std::size_t strongest_j = 0, strongest_n = 0, inside = 0, significant = 0;
  double strongest = -1;
  for (std::size_t j = 0; j < wavelet.scale.size(); ++j) {
    by_frequency.add_row({wavelet.frequency[j], wavelet.period[j], wavelet.scale[j], global[j], in_cone[j], noise[j]});
    for (std::size_t n = 0; n < input.length(); ++n) {
      const double now = wavelet.power(j, n);
      power.values.push_back(now);
      if (wavelet.cone[n] < wavelet.period[j]) continue;
      ++inside;
      if (now > noise[j]) ++significant;
      if (now > strongest) {
        strongest = now;
        strongest_j = j;
        strongest_n = n;
      }
    }
  }
  Table by_time({{"time", "s"}, {"cone_period", "s"}, {"band_power", power_unit}, {"value", channel.unit}});
  const auto band = wavelet.band_power(wavelet.frequency.back(), wavelet.frequency.front());
  for (std::size_t n = 0; n < input.length(); ++n)
    by_time.add_row({input.time(n), wavelet.cone[n], band[n], channel.values[n]});

  report.text = fmt::format("{}: {} scales from {:.6g} Hz to {:.6g} Hz, variance {:.5g} {}, lag-1 correlation {:.4f}\n",
                            channel.name, wavelet.scale.size(), wavelet.frequency.back(), wavelet.frequency.front(),
                            variance, power_unit, correlation);
  if (strongest >= 0) {
    report.text += fmt::format("strongest at {:.6g} Hz, t = {:.6g} s: {:.4g} times the variance\n",
                               wavelet.frequency[strongest_j], input.time(strongest_n), strongest / variance);
    const auto peak = std::max_element(in_cone.begin(), in_cone.end(),
                                       [](double a, double b) { return (std::isnan(a) && !std::isnan(b)) || a < b; }) -
                      in_cone.begin();
    report.text +=
        fmt::format("mean over time largest at {:.6g} Hz; {:.1f} % of time and scales above red noise's 95 %\n",
                    wavelet.frequency[static_cast<std::size_t>(peak)],
                    100.0 * static_cast<double>(significant) / static_cast<double>(inside));
  } else {
    report.text += "note: every scale lies outside the cone of influence: the record is too short for this band\n";
  }
  report.figures = {{"variance", variance}, {"lag_one", correlation}, {"w0", request.w0}};
  report.tables.emplace_back("by_frequency", std::move(by_frequency));
  report.tables.emplace_back("by_time", std::move(by_time));
  report.arrays.push_back(std::move(power));
  return report;
}

}  // namespace railwave
