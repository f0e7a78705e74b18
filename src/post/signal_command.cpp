#include "post/signal_command.hpp"

#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "post/own_file.hpp"
#include "post/signal_report.hpp"
#include "signal/band_pass.hpp"
#include "signal/trend.hpp"

namespace railwave {
namespace {

constexpr OwnFormat format{"Railwave signals", 1, "railwave signal --hdf5"};

/// Columns: those of its table that have always the same name. More: further ones are named after channels, which have
/// a dot.
struct Kind {
  const char* name;
  SignalReport (*report)(const SignalInput&);
  const char* columns;
  const char* more;

  FileKind table() const {
    return table_kind(fmt::format("a table of 'railwave signal {} --csv'", name), columns, more);
  }
};

/// In the order of SignalKind.
constexpr Kind signal_kinds[] = {
    {"psd", report_psd, "frequency [Hz]", "."},
    {"wavelet", report_wavelet, "frequency,period,scale,global_power,global_power_in_cone,red_noise_95", ""},
    {"bandpass", report_bandpass, "time [s]", "."},
    {"cross", report_cross, "frequency,density_first,density_second,cross_density,phase,coherence", ""},
    {"ellipse", report_ellipse,
     "x,y,z,semi_axis_major,semi_axis_minor,tilt,phase,amplitude_ratio,retrograde,polarisation,coherence,strongest_"
     "time",
     ""},
    {"speed", report_speed, "x,y,z,distance,lag,similarity", ""}};

const Kind& kind_of(const SignalRequest& request) { return signal_kinds[static_cast<int>(request.kind)]; }

void check_files(const SignalRequest& request) {
  check_wanted_files({request.results},
                     {{"--csv", request.csv, kind_of(request).table()}, {"--hdf5", request.hdf5, format.kind()}},
                     request.overwrite);
}

void check(const SignalRequest& request, const ResultsReader& results) {
  if (request.channels.empty())
    throw InputError(fmt::format("no channel is named: --channel CHANNEL is wanted; {} has {}", request.results,
                                 history_summary(results)));
  if (!(request.low >= 0 && request.high >= 0 && (request.high == 0 || request.low < request.high)))
    throw InputError(fmt::format("--low {} --high {}: a band is wanted whose upper edge is above the lower one, in Hz",
                                 request.low, request.high));
  if (!(request.segment >= 0))
    throw InputError(fmt::format("--segment {}: a length above 0 is wanted, in s", request.segment));
}

SignalInput read(const SignalRequest& request, const ResultsReader& results) {
  SignalInput input{request, {}};
  const Trend trend = trend_named(request.trend);
  for (const std::string& channel : request.channels) {
    input.entries.push_back(read_history(results, {{channel}, request.from, request.to, request.average}));
    for (HistoryChannel& read : input.entries.back().channels) read.values = without_trend(read.values, trend);
  }
  return input;
}

void fill(const hdf5::Group& root, const SignalInput& input, const SignalReport& report, const char* kind) {
  root.set_attribute("kind", kind);
  std::vector<std::string> names, channel_units;
  for (const HistoryChannel* channel : input.channels()) {
    names.push_back(channel->name);
    channel_units.push_back(channel->unit);
  }
  root.set_attribute("channels", names);
  root.set_attribute("units", channel_units);
  root.set_attribute("start", input.time(0));
  root.set_attribute("interval", input.interval());
  root.set_attribute("low", input.request.low);
  root.set_attribute("high", input.request.high);
  for (const auto& [name, value] : report.figures) root.set_attribute(name, value);
  for (const auto& [name, table] : report.tables) table.write(root.create_group(name));
  for (const auto& array : report.arrays) {
    root.write(array.name, array.values, array.shape, array.unit);
    root.set_attribute(array.name + "_unit", array.unit);
  }
}

}  // namespace

std::vector<const HistoryChannel*> SignalInput::channels() const {
  std::vector<const HistoryChannel*> all;
  for (const HistorySeries& entry : entries)
    for (const HistoryChannel& channel : entry.channels) all.push_back(&channel);
  return all;
}

std::size_t SignalInput::segment(std::size_t otherwise) const {
  return request.segment > 0 ? static_cast<std::size_t>(std::lround(request.segment / interval())) : otherwise;
}

std::vector<std::pair<const HistoryChannel*, const HistoryChannel*>> channel_pairs(const SignalInput& input) {
  if (input.entries.size() != 2)
    throw InputError(
        fmt::format("{} --channel are given, two are wanted: what is compared, and what with", input.entries.size()));
  const auto& first = input.entries[0].channels;
  const auto& second = input.entries[1].channels;
  if (first.size() != second.size())
    throw InputError(
        fmt::format("'{}' finds {} channels and '{}' {}: as many are wanted, which are compared pair by pair; or make "
                    "each their mean by --average",
                    input.request.channels[0], first.size(), input.request.channels[1], second.size()));
  std::vector<std::pair<const HistoryChannel*, const HistoryChannel*>> pairs;
  for (std::size_t i = 0; i < first.size(); ++i) pairs.emplace_back(&first[i], &second[i]);
  return pairs;
}

std::vector<double> in_band(const std::vector<double>& values, const SignalInput& input) {
  const SignalRequest& request = input.request;
  return request.low > 0 || request.high > 0
             ? band_passed(values, input.interval(), {request.low, request.high, request.order})
             : values;
}

std::string product_unit(const std::string& a, const std::string& b) {
  const auto guarded = [](const std::string& unit) {
    return unit.find_first_of("/ 2") == std::string::npos ? unit : '(' + unit + ')';
  };
  if (a == b) return a == "1" ? "1" : guarded(a) + "2";
  return guarded(a) + ' ' + guarded(b);
}

double mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value / static_cast<double>(values.size());
  return sum;
}

std::string band_text(const SignalRequest& request) {
  if (request.low > 0 && request.high > 0) return fmt::format("from {:.6g} Hz to {:.6g} Hz", request.low, request.high);
  if (request.low > 0) return fmt::format("above {:.6g} Hz", request.low);
  if (request.high > 0) return fmt::format("below {:.6g} Hz", request.high);
  return "at all frequencies";
}

int signal_command(const SignalRequest& request, std::ostream& out) {
  check_files(request);
  const ResultsReader results(request.results);
  check(request, results);
  const SignalInput input = read(request, results);
  if (!results.completed()) out << "note: this run did not complete: " << results.reason() << '\n';
  for (const std::string& note : input.entries.front().notes) out << "note: " << note << '\n';
  const Kind& kind = kind_of(request);
  const SignalReport report = kind.report(input);
  out << fmt::format("{} samples every {:.6g} s from {:.6g} s\n", input.length(), input.interval(), input.time(0))
      << report.text;
  if (request.csv) write_table(*request.csv, report.tables.front().second.csv(), kind.table());
  if (request.hdf5)
    write_own_file(*request.hdf5, format, results,
                   [&](const hdf5::Group& root) { fill(root, input, report, kind.name); });
  return 0;
}

}  // namespace railwave
