#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "post/contact_tables.hpp"
#include "post/history_series.hpp"
#include "post/results_reader.hpp"
#include "signal/welch.hpp"
#include "sweep/figure.hpp"
#include "sweep/overrides_of_members.hpp"

namespace railwave::sweep {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Where the density is largest between two frequencies, to a part of their distance: the top of the parabola through
/// the logarithms of three values.
double peak_frequency(const std::vector<double>& values, double interval, const Figure& figure) {
  WelchOptions options;
  options.segment = values.size();
  const PowerDensity found = power_density(values, interval, options);
  std::size_t peak = 0;
  for (std::size_t k = 1; k < found.density.size(); ++k)
    if (found.frequency[k] >= figure.low && found.frequency[k] <= figure.high &&
        (peak == 0 || found.density[k] > found.density[peak]))
      peak = k;
  if (peak == 0 || !(found.density[peak] > 0)) return unknown;
  if (peak + 1 == found.density.size() || !(found.density[peak - 1] > 0 && found.density[peak + 1] > 0))
    return found.frequency[peak];
  const double a = std::log(found.density[peak - 1]), b = std::log(found.density[peak]),
               c = std::log(found.density[peak + 1]), bend = a - 2 * b + c;
  const double shift = bend < 0 ? std::clamp(0.5 * (a - c) / bend, -0.5, 0.5) : 0;
  return found.frequency[peak] + shift * found.frequency[1];
}

/// @param values in the order of time; those that are not known count for nothing, but for the last one
double taken(const std::vector<double>& values, Take take) {
  if (values.empty()) return unknown;
  if (take == Take::last) return values.back();
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](double v) { return !std::isnan(v); });
  if (known.empty()) return unknown;
  double sum = 0, squares = 0;
  for (const double v : known) sum += v, squares += v * v;
  const auto count = static_cast<double>(known.size());
  switch (take) {
    case Take::mean:
      return sum / count;
    case Take::minimum:
      return *std::min_element(known.begin(), known.end());
    case Take::maximum:
      return *std::max_element(known.begin(), known.end());
    case Take::largest:
      return *std::max_element(known.begin(), known.end(),
                               [](double a, double b) { return std::fabs(a) < std::fabs(b); });
    case Take::rms:
      return std::sqrt(squares / count);
    default:
      return known.back();
  }
}

[[noreturn]] void refuse(const Figure& figure, const std::string& why) {
  throw InputError(fmt::format("[figures] {}: {}", figure.name, why));
}

class Run {
 public:
  Run(const std::string& path, const ContactRequest& request) : results_(path), request_(request) {
    request_.results = path;
  }

  FigureValue patch(const Figure& figure) {
    const std::vector<std::string> contacts = results_.contacts();
    if (std::find(contacts.begin(), contacts.end(), figure.contact) == contacts.end())
      refuse(figure, fmt::format("there is no contact '{}' in {}; {}", figure.contact, results_.path(),
                                 contacts.empty() ? "it has none" : suggestion(figure.contact, contacts)));
    auto found = patches_.find(figure.contact);
    if (found == patches_.end())
      found =
          patches_.emplace(figure.contact, contact_tables(results_, figure.contact, {figure.contact}, request_)).first;
    const Table& table = found->second.patches;
    std::vector<double> values;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
      const double time = table.at(row, "time");
      if (table.at(row, "patch") == 0 && time >= figure.from && time <= figure.to)
        values.push_back(table.at(row, figure.quantity));
    }
    if (values.empty()) refuse(figure, fmt::format("no output lies from {} s to {} s", figure.from, figure.to));
    const auto& columns = table.columns();
    const auto column =
        std::find_if(columns.begin(), columns.end(), [&](const Column& one) { return one.name == figure.quantity; });
    return {figure.name, column->unit, taken(values, figure.take)};
  }

  FigureValue history(const Figure& figure) const {
    HistoryRequest request;
    request.channels = {figure.quantity};
    request.from = figure.from;
    request.to = figure.to;
    const HistorySeries series = [&] {
      try {
        return read_history(results_, request);
      } catch (const InputError& error) {
        refuse(figure, error.what());
      }
    }();
    if (series.channels.size() != 1)
      refuse(figure, fmt::format("{} finds {} histories; name one", figure.quantity, series.channels.size()));
    const HistoryChannel& channel = series.channels.front();
    if (figure.take == Take::frequency)
      return {figure.name, "Hz", peak_frequency(channel.values, series.interval, figure)};
    return {figure.name, channel.unit, taken(channel.values, figure.take)};
  }

 private:
  ResultsReader results_;
  ContactRequest request_;
  std::map<std::string, ContactTables> patches_;
};

FigureValue mode_frequency(const Figure& figure, const CsvRows& table) {
  const auto& heading = table.front().cells;
  const auto column = std::find_if(heading.begin(), heading.end(),
                                   [](const std::string& name) { return name.rfind("frequency", 0) == 0; });
  const auto place = static_cast<std::size_t>(column - heading.begin());
  const auto row = static_cast<std::size_t>(figure.mode);
  double value = unknown;  // fewer modes below the highest frequency asked for
  if (row < table.size() && place < table[row].cells.size()) {
    const std::string& cell = table[row].cells[place];
    std::from_chars(cell.data(), cell.data() + cell.size(), value);
  }
  return {figure.name, "Hz", value};
}

}  // namespace

std::vector<FigureValue> collect(const FigureChoice& choice, const std::string& results, const std::string& modes) {
  std::optional<Run> run;
  CsvRows table;
  if (choice.need_run()) run.emplace(results, choice.patches);
  if (choice.need_modes()) table = read_csv(modes);
  std::vector<FigureValue> values;
  for (const Figure& figure : choice.figures)
    values.push_back(figure.source == Figure::Source::mode    ? mode_frequency(figure, table)
                     : figure.source == Figure::Source::patch ? run->patch(figure)
                                                              : run->history(figure));
  return values;
}

}  // namespace railwave::sweep
