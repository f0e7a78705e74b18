#include "post/decay_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>

#include "case/error.hpp"
#include "post/hammer_test.hpp"
#include "post/own_file.hpp"
#include "signal/decay_rate.hpp"

namespace railwave {
namespace {

/// m; probes nearer to the force than that are at it.
constexpr double at_force = 1e-3;

struct Probe {
  double distance;
  HammerResponse where;
};

/// Probes along the row, ascending from the force, which comes first; those on the side that has fewer are left out.
std::vector<Probe> probes_of(const HammerTest& test, const DecayRequest& request, std::vector<std::string>& notes) {
  const std::string along = request.direction.empty() ? "" : ":" + request.direction;
  const std::string part = test.input().set.substr(0, test.input().set.find('.'));
  std::vector<HammerResponse> found;
  if (request.rows.empty()) {
    for (const HammerResponse& one : test.all())
      if (one.set != test.input().set && one.set.compare(0, part.size() + 1, part + ".") == 0)
        found.push_back(test.find(one.set + along).front());
  }
  for (const std::string& row : request.rows)
    for (const HammerResponse& one : test.find(row + along)) found.push_back(one);
  const std::string first = request.at.empty() ? test.input().set : test.find(request.at).front().set;
  const auto struck = test.place(first);
  if (!struck) throw InputError("the results file does not tell where its sets are; repeat the run with this program");
  std::vector<Probe> before, behind;
  for (const HammerResponse& one : found) {
    const auto place = test.place(one.set);
    const double way = place ? (*place)[0] - (*struck)[0] : 0;
    if (std::fabs(way) >= at_force) (way < 0 ? before : behind).push_back({std::fabs(way), one});
  }
  if (before.size() > behind.size()) before.swap(behind);
  if (!before.empty())
    notes.push_back(fmt::format("{} probes on the other side of the force are left out", before.size()));
  std::vector<Probe> probes{{0, test.find(first + along).front()}};
  probes.insert(probes.end(), behind.begin(), behind.end());
  std::sort(probes.begin(), probes.end(), [](const Probe& a, const Probe& b) { return a.distance < b.distance; });
  probes.erase(std::unique(probes.begin(), probes.end(),
                           [](const Probe& a, const Probe& b) { return b.distance - a.distance < at_force; }),
               probes.end());
  if (probes.size() < 3)
    throw InputError(
        fmt::format("a decay rate needs the force and two places beside it along x at least, but has {}; add a row: "
                    "[probes.NAME] with count and spacing",
                    probes.size() - 1));
  return probes;
}

/// Rates, and the places that they come from.
struct Measured {
  std::vector<Probe> probes;
  std::vector<BandDecay> rates;
  double reliable = 0;  ///< Hz, up to where the force's spectrum is strong enough
};

Measured measure(const HammerTest& test, const DecayRequest& request, SignalNotes& notes) {
  Measured found;
  found.probes = probes_of(test, request, notes.texts);
  const ResponseSettings settings = ResponseSettings::of(request.resolution, request.window, request.window_end);
  std::vector<PlacedResponse> places;
  std::vector<double> frequency;
  for (const Probe& probe : found.probes) {
    FrequencyResponse response = test.accelerance(probe.where, settings, notes);
    if (frequency.empty()) frequency = response.frequency, found.reliable = force_limit(response, 20);
    places.push_back({probe.distance, std::move(response.value)});
  }
  auto bands = third_octaves(0.85 * request.from, std::min(1.2 * request.to, frequency.back()));
  const auto outside = [&](const ThirdOctave& band) {
    return band.nominal < request.from || band.nominal > request.to;
  };
  bands.erase(std::remove_if(bands.begin(), bands.end(), outside), bands.end());
  if (bands.empty())
    throw InputError(fmt::format("no third-octave band (100, 125, 160 Hz ...) lies from {} Hz to {} Hz", request.from,
                                 std::min(request.to, frequency.back())));
  found.rates = decay_rates(frequency, places, bands);
  return found;
}

void print(std::ostream& out, const Measured& measured) {
  out << fmt::format("  {:>8} {:>8}\n", "band Hz", "dB/m");
  bool short_row = false, weak = false;
  for (const BandDecay& one : measured.rates) {
    const bool unsure = one.rate < 1.5 * one.least;
    const bool thin = one.band.high > measured.reliable;
    short_row = short_row || unsure;
    weak = weak || thin;
    out << fmt::format("  {:>8g} {:>8.3f}{}{}\n", one.band.nominal, one.rate, unsure ? " (row too short)" : "",
                       thin ? " (force weak)" : "");
  }
  if (short_row)
    out << fmt::format(
        "note: a row so long tells no rates below {:.2g} dB/m; those below 1.5 times that are too high\n",
        measured.rates.front().least);
  if (weak)
    out << fmt::format(
        "note: above {:.0f} Hz the force's spectrum is more than 20 dB below its beginning: strike with a "
        "shorter blow\n",
        measured.reliable);
}

constexpr OwnFormat file_format{"Railwave decay rates", 1, "railwave decay --hdf5"};
constexpr const char* heading = "band,centre,low,high,decay_rate,least";

FileKind rate_table() { return table_kind("a table of 'railwave decay --csv'", heading, "level_"); }

std::string csv(const Measured& measured) {
  fmt::memory_buffer text;
  const auto add = std::back_inserter(text);
  fmt::format_to(add, "{}", heading);
  for (const Probe& probe : measured.probes) fmt::format_to(add, ",level_{:.6g}", probe.distance);
  text.push_back('\n');
  for (const BandDecay& one : measured.rates) {
    fmt::format_to(add, "{:g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g}", one.band.nominal, one.band.centre, one.band.low,
                   one.band.high, one.rate, one.least);
    for (double level : one.level) fmt::format_to(add, ",{:.4f}", level);
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

void fill(const hdf5::Group& root, const Measured& measured, const std::string& load) {
  root.set_attribute("input", load);
  const auto column = [&](const char* name, const char* unit, const auto& value_of) {
    std::vector<double> values;
    for (const BandDecay& one : measured.rates) values.push_back(value_of(one));
    root.write(name, values, {values.size()}, unit);
    root.set_attribute(name, unit);
  };
  column("band", "Hz", [](const BandDecay& one) { return one.band.nominal; });
  column("low", "Hz", [](const BandDecay& one) { return one.band.low; });
  column("high", "Hz", [](const BandDecay& one) { return one.band.high; });
  column("decay_rate", "dB/m", [](const BandDecay& one) { return one.rate; });
  column("least", "dB/m", [](const BandDecay& one) { return one.least; });
  std::vector<double> distances, levels;
  for (const Probe& probe : measured.probes) distances.push_back(probe.distance);
  for (const BandDecay& one : measured.rates) levels.insert(levels.end(), one.level.begin(), one.level.end());
  root.write("distance", distances, {distances.size()}, "m");
  root.set_attribute("distance", "m");
  root.write("level", levels, {measured.rates.size(), distances.size()}, "dB");
  root.set_attribute("level", "dB");
}

}  // namespace

int decay_command(const DecayRequest& request, std::ostream& out) {
  if (!(request.from > 0 && request.from < request.to))
    throw InputError(fmt::format("--from {} --to {}: must be above 0 and ascend", request.from, request.to));
  check_wanted_files(request.results,
                     {{"--csv", request.csv, rate_table()}, {"--hdf5", request.hdf5, file_format.kind()}},
                     request.overwrite);
  const HammerTest test(request.results, request.input);
  SignalNotes notes;
  const Measured measured = measure(test, request, notes);
  const auto& probes = measured.probes;
  out << fmt::format("decay rate by EN 15461 of {} along {}: {} places from {:.4g} m to {:.4g} m beside {}\n",
                     probes.front().where.set.substr(0, probes.front().where.set.find('.')),
                     request.direction.empty() ? "the force" : request.direction, probes.size() - 1, probes[1].distance,
                     probes.back().distance, test.input().load);
  print(out, measured);
  for (const std::string& text : notes.summary()) out << "note: " << text << '\n';
  if (request.csv) write_table(*request.csv, csv(measured), rate_table());
  if (request.hdf5)
    write_own_file(*request.hdf5, file_format, test.first(),
                   [&](const hdf5::Group& root) { fill(root, measured, test.input().load); });
  return 0;
}

}  // namespace railwave
