#include "post/response_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "output/hdf5/hdf5.hpp"
#include "post/hammer_test.hpp"
#include "post/own_file.hpp"
#include "signal/frequency_response.hpp"

namespace railwave {
namespace {

const std::vector<std::string> quantities = {"accelerance", "mobility", "receptance"};
const std::vector<std::string> units = {"m/s2/N", "m/s/N", "m/N"};
constexpr OwnFormat file_format{"Railwave frequency responses", 1, "railwave frf --hdf5"};

constexpr const char* heading =
    "response,kind,frequency,amplitude,decibels,phase,real,imaginary,coherence,force_spectrum";

FileKind response_table() { return table_kind("a table of 'railwave frf --csv'", heading); }

int integrations(const ResponseRequest& request) {
  return static_cast<int>(std::find(quantities.begin(), quantities.end(), request.quantity) - quantities.begin());
}

void check(const ResponseRequest& request) {
  if (integrations(request) == static_cast<int>(quantities.size()))
    throw InputError(fmt::format("--quantity {}: must be accelerance, mobility or receptance; {}", request.quantity,
                                 suggestion(request.quantity, quantities)));
  if (!(request.prominence > 0))
    throw InputError(fmt::format("--prominence {}: must be above 0 dB", request.prominence));
  if (request.from && request.to && !(*request.from < *request.to))
    throw InputError(fmt::format("--from {} is not below --to {}", *request.from, *request.to));
  check_wanted_files(request.results,
                     {{"--csv", request.csv, response_table()}, {"--hdf5", request.hdf5, file_format.kind()}},
                     request.overwrite);
}

/// A response and the lines of it that are reported and written.
struct ReportedResponse {
  HammerResponse where;
  FrequencyResponse lines;
  std::vector<Resonance> resonances;
};

/// Only what lies between the two frequencies.
FrequencyResponse cut(const FrequencyResponse& whole, double from, double to) {
  FrequencyResponse part;
  for (std::size_t k = 0; k < whole.frequency.size(); ++k) {
    if (whole.frequency[k] < from || whole.frequency[k] > to) continue;
    part.frequency.push_back(whole.frequency[k]);
    part.value.push_back(whole.value[k]);
    part.coherence.push_back(whole.coherence[k]);
    part.force.push_back(whole.force[k]);
  }
  if (part.frequency.size() < 3)
    throw InputError(fmt::format("from {} Hz to {} Hz there are {} lines; they go up to {:.6g} Hz", from, to,
                                 part.frequency.size(), whole.frequency.back()));
  return part;
}

double decibels(double amplitude) { return 20 * std::log10(std::max(amplitude, 1e-300)); }
double degrees(const Complex& value) { return 180 / M_PI * std::arg(value); }

void print(std::ostream& out, const ReportedResponse& reported, const std::string& unit) {
  out << fmt::format("{} ({})\n", reported.where.name, reported.where.kind);
  if (reported.resonances.empty())
    out << "  no peak or trough\n";
  else
    out << fmt::format("  {:>6} {:>10} {:>13} {:>8} {:>10}\n", "", "Hz", unit, "dB", "damping %");
  for (const Resonance& one : reported.resonances)
    out << fmt::format("  {:>6} {:>10.1f} {:>13.4g} {:>8.1f} {:>10}\n", one.peak ? "peak" : "trough", one.frequency,
                       one.amplitude, decibels(one.amplitude),
                       one.damping && one.peak ? fmt::format("{:.2f}", 100 * *one.damping) : "-");
}

std::string csv(const std::vector<ReportedResponse>& all) {
  fmt::memory_buffer text;
  const auto add = std::back_inserter(text);
  fmt::format_to(add, "{}\n", heading);
  for (const ReportedResponse& one : all)
    for (std::size_t k = 0; k < one.lines.frequency.size(); ++k) {
      const Complex value = one.lines.value[k];
      const std::string name =
          one.where.name.find(',') == std::string::npos ? one.where.name : '"' + one.where.name + '"';
      fmt::format_to(add, "{},{},{:.10g},{:.10g},{:.6f},{:.6f},{:.10g},{:.10g},{:.8g},{:.8g}\n", name, one.where.kind,
                     one.lines.frequency[k], std::abs(value), decibels(std::abs(value)), degrees(value), value.real(),
                     value.imag(), one.lines.coherence[k], one.lines.force[k]);
    }
  return fmt::to_string(text);
}

template <class Of>
void write(const hdf5::Group& group, const char* name, const char* unit, std::size_t count, const Of& value) {
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = value(k);
  group.write(name, values, {count}, unit);
  group.set_attribute(name, unit);
}

void write_file(const std::string& path, const HammerTest& test, const ResponseRequest& request,
                const std::vector<ReportedResponse>& all) {
  write_own_file(path, file_format, test.first(), [&](const hdf5::Group& root) {
    root.set_attribute("results_files", request.results);
    root.set_attribute("input", test.input().load);
    root.set_attribute("quantity", request.quantity);
    const char* unit = units[static_cast<std::size_t>(integrations(request))].c_str();
    for (const ReportedResponse& one : all) {
      const hdf5::Group group = root.create_group(one.where.name);
      group.set_attribute("kind", one.where.kind);
      const FrequencyResponse& lines = one.lines;
      const std::size_t count = lines.frequency.size();
      write(group, "frequency", "Hz", count, [&](std::size_t k) { return lines.frequency[k]; });
      write(group, "real", unit, count, [&](std::size_t k) { return lines.value[k].real(); });
      write(group, "imaginary", unit, count, [&](std::size_t k) { return lines.value[k].imag(); });
      write(group, "coherence", "1", count, [&](std::size_t k) { return lines.coherence[k]; });
      write(group, "force_spectrum", "N s", count, [&](std::size_t k) { return lines.force[k]; });
    }
  });
}

}  // namespace

int response_command(const ResponseRequest& request, std::ostream& out) {
  check(request);
  const HammerTest test(request.results, request.input);
  const ResponseSettings settings = ResponseSettings::of(request.resolution, request.window, request.window_end);
  const double decay = test.decay(settings);

  std::vector<HammerResponse> places;
  for (const std::string& text : request.responses)
    for (const HammerResponse& place : test.find(text)) places.push_back(place);
  if (request.responses.empty()) places = test.all();

  SignalNotes notes;
  std::vector<ReportedResponse> all;
  double reliable = 0;
  for (const HammerResponse& place : places) {
    FrequencyResponse whole = test.accelerance(place, settings, notes);
    if (all.empty()) {
      const auto& d = test.input().direction;
      out << fmt::format(
          "input {}: on {} along {:.4g}, {:.4g}, {:.4g}; its spectrum is 3 dB down at {:.0f} Hz, 10 dB at {:.0f} Hz\n",
          test.input().load, test.input().set, d[0], d[1], d[2], force_limit(whole, 3), force_limit(whole, 10));
      out << fmt::format(
          "{} blow{}; {}; lines every {:.4g} Hz\n", test.blows(),
          test.blows() == 1 ? ", so that the coherence is 1 by definition" : "s, averaged (H1)",
          settings.window_end < 1
              ? fmt::format("exponential window down to {:.3g}, its damping taken off", settings.window_end)
              : std::string("no window"),
          whole.frequency[1]);
      reliable = force_limit(whole, 20);
    }
    integrate(whole, integrations(request), decay);
    ReportedResponse reported{place, cut(whole, request.from.value_or(20), request.to.value_or(reliable)), {}};
    reported.resonances = find_resonances(reported.lines.frequency, reported.lines.value, request.prominence, decay);
    all.push_back(std::move(reported));
  }
  for (const ReportedResponse& one : all) print(out, one, units[static_cast<std::size_t>(integrations(request))]);
  for (const std::string& text : notes.summary()) out << "note: " << text << '\n';
  if (request.csv) write_table(*request.csv, csv(all), response_table());
  if (request.hdf5) write_file(*request.hdf5, test, request, all);
  return 0;
}

}  // namespace railwave
