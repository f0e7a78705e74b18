// railwave signal psd, bandpass and cross: what Welch's method and filters find.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "case/error.hpp"
#include "post/signal_report.hpp"
#include "signal/welch.hpp"

namespace railwave {
namespace {

constexpr int peaks_shown = 3;

WelchOptions welch_options(const SignalInput& input, std::size_t segment) {
  WelchOptions options;
  options.segment = input.segment(segment);
  options.overlap = input.request.overlap;
  options.window = window_named(input.request.window);
  options.trend = Trend::mean;
  if (input.request.trend == "none") options.trend = Trend::none;
  return options;
}

bool within(double frequency, const SignalRequest& request) {
  return frequency >= request.low && (request.high == 0 || frequency <= request.high);
}

/// The highest local maxima in the request's band, highest first.
std::vector<std::size_t> highest_peaks(const std::vector<double>& frequency, const std::vector<double>& density,
                                       const SignalRequest& request) {
  std::vector<std::size_t> peaks;
  for (std::size_t k = 1; k + 1 < density.size(); ++k)
    if (within(frequency[k], request) && density[k] > density[k - 1] && density[k] >= density[k + 1])
      peaks.push_back(k);
  const std::size_t count = std::min<std::size_t>(peaks_shown, peaks.size());
  std::partial_sort(peaks.begin(), peaks.begin() + static_cast<std::ptrdiff_t>(count), peaks.end(),
                    [&](std::size_t a, std::size_t b) { return density[a] > density[b]; });
  peaks.resize(count);
  return peaks;
}

}  // namespace

SignalReport report_psd(const SignalInput& input) {
  const WelchOptions options = welch_options(input, 0);
  const auto channels = input.channels();
  SignalReport report;
  std::vector<Column> columns{{"frequency", "Hz"}};
  std::vector<PowerDensity> all;
  for (const HistoryChannel* channel : channels) {
    columns.push_back({channel->name, product_unit(channel->unit, channel->unit) + "/Hz"});
    all.push_back(power_density(channel->values, input.interval(), options));
    const PowerDensity& psd = all.back();
    const double highest = input.request.high > 0 ? input.request.high : psd.frequency.back() + 1;
    const double power = band_power(psd.frequency, psd.density, input.request.low, highest);
    if (channel == channels.front())
      report.text += fmt::format("{} {} of {} samples, {:.6g} Hz from one frequency to the next\n", psd.segments,
                                 psd.segments == 1 ? "segment" : "segments", psd.segment_length, psd.frequency[1]);
    report.text += fmt::format("{}: root mean square {:.5g} {} {}; peaks", channel->name, std::sqrt(power),
                               channel->unit, band_text(input.request));
    const auto peaks = highest_peaks(psd.frequency, psd.density, input.request);
    for (const std::size_t k : peaks)
      report.text += fmt::format(" {:.6g} Hz ({:.3g} {})", psd.frequency[k], psd.density[k], columns.back().unit);
    report.text += peaks.empty() ? " none\n" : "\n";
  }
  Table table(columns);
  for (std::size_t k = 0; k < all.front().frequency.size(); ++k) {
    std::vector<double> row{all.front().frequency[k]};
    for (const PowerDensity& psd : all) row.push_back(psd.density[k]);
    table.add_row(row);
  }
  report.figures = {{"segments", static_cast<double>(all.front().segments)},
                    {"segment_length", static_cast<double>(all.front().segment_length)}};
  report.tables.emplace_back("psd", std::move(table));
  return report;
}

SignalReport report_bandpass(const SignalInput& input) {
  if (input.request.low == 0 && input.request.high == 0)
    throw InputError("a band is wanted: --low and --high, in Hz, or one of them");
  SignalReport report;
  std::vector<Column> columns{{"time", "s"}};
  std::vector<std::vector<double>> all;
  report.text = fmt::format("{}\n", band_text(input.request));
  for (const HistoryChannel* channel : input.channels()) {
    columns.push_back({channel->name, channel->unit});
    all.push_back(in_band(channel->values, input));
    const auto largest = std::max_element(all.back().begin(), all.back().end(),
                                          [](double a, double b) { return std::fabs(a) < std::fabs(b); });
    report.text +=
        fmt::format("{}: root mean square {:.5g} of {:.5g} {}, largest {:.5g} {} at {:.6g} s\n", channel->name,
                    std::sqrt(mean_square(all.back())), std::sqrt(mean_square(channel->values)), channel->unit,
                    *largest, channel->unit, input.time(static_cast<std::size_t>(largest - all.back().begin())));
  }
  Table table(columns);
  for (std::size_t n = 0; n < input.length(); ++n) {
    std::vector<double> row{input.time(n)};
    for (const auto& values : all) row.push_back(values[n]);
    table.add_row(row);
  }
  report.tables.emplace_back("bandpass", std::move(table));
  return report;
}

SignalReport report_cross(const SignalInput& input) {
  const auto pairs = channel_pairs(input);
  std::vector<std::vector<double>> first, second;
  for (const auto& [a, b] : pairs) {
    first.push_back(a->values);
    second.push_back(b->values);
  }
  const CrossSpectra spectra =
      cross_spectra(first, second, input.interval(), welch_options(input, pairs.size() > 1 ? input.length() : 0));
  const auto coherence = spectra.coherence(), phase = spectra.phase();
  const std::string a = pairs.front().first->unit, b = pairs.front().second->unit;
  Table table({{"frequency", "Hz"},
               {"density_first", product_unit(a, a) + "/Hz"},
               {"density_second", product_unit(b, b) + "/Hz"},
               {"cross_density", product_unit(a, b) + "/Hz"},
               {"phase", "deg"},
               {"coherence", "1"}});
  Complex sum = 0;
  double power_a = 0, power_b = 0, most = 0, agreed = 0, weights = 0;
  std::size_t peak = 0;
  for (std::size_t k = 0; k < spectra.frequency.size(); ++k) {
    const double size = std::abs(spectra.cross[k]);
    table.add_row({spectra.frequency[k], spectra.density_a[k], spectra.density_b[k], size,
                   degrees_per_radian * phase[k], coherence[k]});
    if (!within(spectra.frequency[k], input.request)) continue;
    sum += spectra.cross[k];
    power_a += spectra.density_a[k];
    power_b += spectra.density_b[k];
    const double weight = std::sqrt(spectra.density_a[k] * spectra.density_b[k]);
    agreed += weight * coherence[k];
    weights += weight;
    if (size > most) {
      most = size;
      peak = k;
    }
  }
  if (!(most > 0)) throw InputError(fmt::format("the channels have nothing in common {}", band_text(input.request)));
  SignalReport report;
  report.text = fmt::format("{} {} of {} samples, of {} {}: {:.6g} Hz from one frequency to the next\n",
                            spectra.segments, spectra.segments == 1 ? "segment" : "segments", spectra.segment_length,
                            pairs.size(), pairs.size() == 1 ? "pair" : "pairs", spectra.frequency[1]);
  report.text += fmt::format("first {}, second {}{}\n", pairs.front().first->name, pairs.front().second->name,
                             pairs.size() > 1 ? " and so on" : "");
  report.text += fmt::format(
      "{}: phase of the second before the first {:.2f} deg, coherence {:.4f} (mean by power), amplitude second to "
      "first {:.4f}\n",
      band_text(input.request), degrees_per_radian * std::arg(sum), agreed / weights, std::sqrt(power_b / power_a));
  report.text += fmt::format("most in common at {:.6g} Hz: phase {:.2f} deg, coherence {:.4f}\n",
                             spectra.frequency[peak], degrees_per_radian * phase[peak], coherence[peak]);
  if (spectra.segments == 1)
    report.text +=
        "note: of one segment coherence is 1 whatever the channels; cut shorter ones by --segment, or name several "
        "pairs\n";
  report.figures = {{"segments", static_cast<double>(spectra.segments)},
                    {"band_phase", degrees_per_radian * std::arg(sum)},
                    {"band_coherence", agreed / weights}};
  report.tables.emplace_back("cross", std::move(table));
  return report;
}

}  // namespace railwave
