// railwave signal ellipse and speed: what a wave does to a particle, and how fast it comes along a row.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "case/error.hpp"
#include "post/signal_report.hpp"
#include "signal/particle_motion.hpp"
#include "signal/wave_speed.hpp"

namespace railwave {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct Row {
  std::vector<const HistoryChannel*> channels;  ///< by distance
  std::vector<double> distance;                 ///< m, from the first
  Eigen::Vector3d along;
};

/// The channels by their distance along the line between the two that lie farthest apart.
Row row_of(const SignalInput& input) {
  Row row{input.channels(), {}, Eigen::Vector3d::Zero()};
  if (row.channels.size() < 4)
    throw InputError(
        fmt::format("{} channels are named: a wave speed needs the histories of four sets in a row at least, e.g. "
                    "--channel 'rail.row_*.velocity.z'",
                    row.channels.size()));
  for (const HistoryChannel* channel : row.channels)
    if (!channel->position)
      throw InputError(
          fmt::format("where '{}' is measured is not known: a wave speed needs histories of sets, of a run whose "
                      "results tell where they are (run it again)",
                      channel->name));
  for (const HistoryChannel* a : row.channels)
    for (const HistoryChannel* b : row.channels)
      if ((*b->position - *a->position).norm() > row.along.norm()) row.along = *b->position - *a->position;
  if (!(row.along.norm() > 0)) throw InputError("all channels are measured at the same place: there is no row");
  row.along.normalize();
  // Towards the positive axis that is nearest, so that the sign of a speed does not hang on the order of names.
  int axis = 0;
  row.along.cwiseAbs().maxCoeff(&axis);
  if (row.along[axis] < 0) row.along = -row.along;
  for (double& component : row.along)
    if (std::fabs(component) < 1e-9) component = 0;  // rounding, no direction
  const auto place = [&](const HistoryChannel* channel) { return row.along.dot(*channel->position); };
  std::stable_sort(row.channels.begin(), row.channels.end(),
                   [&](const auto* a, const auto* b) { return place(a) < place(b); });
  for (const HistoryChannel* channel : row.channels)
    row.distance.push_back(place(channel) - place(row.channels.front()));
  return row;
}

}  // namespace

SignalReport report_ellipse(const SignalInput& input) {
  const auto pairs = channel_pairs(input);
  const std::string unit = pairs.front().first->unit;
  if (pairs.front().second->unit != unit)
    throw InputError(fmt::format("an ellipse needs two components of the same motion: one is in {}, the other in {}",
                                 unit, pairs.front().second->unit));
  Table table({{"x", "m"},
               {"y", "m"},
               {"z", "m"},
               {"semi_axis_major", unit},
               {"semi_axis_minor", unit},
               {"tilt", "deg"},
               {"phase", "deg"},
               {"amplitude_ratio", "1"},
               {"retrograde", "1"},
               {"polarisation", "1"},
               {"coherence", "1"},
               {"strongest_time", "s"}});
  SignalReport report;
  report.text = fmt::format("{}; first {}, second {}{}\n", band_text(input.request), pairs.front().first->name,
                            pairs.front().second->name, pairs.size() > 1 ? " and so on" : "");
  report.text += fmt::format("{:>32} {:>10} {:>10} {:>8} {:>9} {:>13} {:>12} {:>9}\n", "", "major", "minor", "tilt",
                             "phase", "second/first", "sense", "polarised");
  report.text +=
      fmt::format("{:>32} {:>10} {:>10} {:>8} {:>9} {:>13} {:>12} {:>9}\n", "", unit, unit, "deg", "deg", "", "", "");
  SignalReport::Array first{"first", unit, {pairs.size(), input.length()}, {}},
      second{"second", unit, {pairs.size(), input.length()}, {}};
  std::size_t retrograde = 0;
  for (const auto& [a, b] : pairs) {
    const auto along = in_band(a->values, input), up = in_band(b->values, input);
    const ParticleMotion m = particle_motion(along, up);
    const Eigen::Vector3d place = a->position.value_or(Eigen::Vector3d::Constant(unknown));
    table.add_row({place[0], place[1], place[2], m.semi_axis_major, m.semi_axis_minor, degrees_per_radian * m.tilt,
                   degrees_per_radian * m.phase, m.amplitude_ratio, m.retrograde() ? 1.0 : 0.0, m.polarisation,
                   m.coherence, input.time(m.strongest)});
    report.text +=
        fmt::format("{:>32} {:>10.4g} {:>10.4g} {:>8.2f} {:>9.2f} {:>13.4f} {:>12} {:>9.4f}\n", a->name,
                    m.semi_axis_major, m.semi_axis_minor, degrees_per_radian * m.tilt, degrees_per_radian * m.phase,
                    m.amplitude_ratio, m.retrograde() ? "retrograde" : "prograde", m.polarisation);
    retrograde += m.retrograde() ? 1 : 0;
    first.values.insert(first.values.end(), along.begin(), along.end());
    second.values.insert(second.values.end(), up.begin(), up.end());
  }
  if (pairs.size() > 1) report.text += fmt::format("retrograde: {} of {}\n", retrograde, pairs.size());
  report.tables.emplace_back("ellipse", std::move(table));
  report.arrays = {std::move(first), std::move(second)};
  return report;
}

SignalReport report_speed(const SignalInput& input) {
  const Row row = row_of(input);
  const SignalRequest& request = input.request;
  std::vector<std::vector<double>> as_read, filtered;
  for (const HistoryChannel* channel : row.channels) {
    as_read.push_back(channel->values);
    filtered.push_back(in_band(channel->values, input));
  }
  const TimeOfFlight flight = time_of_flight(filtered, row.distance, input.interval());
  const FrequencyWavenumber fk =
      frequency_wavenumber(as_read, row.distance, input.interval(), request.low, request.high);

  Table probes({{"x", "m"}, {"y", "m"}, {"z", "m"}, {"distance", "m"}, {"lag", "s"}, {"similarity", "1"}});
  for (std::size_t p = 0; p < row.channels.size(); ++p) {
    const Eigen::Vector3d& place = *row.channels[p]->position;
    probes.add_row({place[0], place[1], place[2], row.distance[p], flight.lag[p], flight.similarity[p]});
  }
  Table ridge({{"frequency", "Hz"}, {"wavenumber", "1/m"}, {"phase_speed", "m/s"}, {"power", "1"}});
  SignalReport::Array power{"power", "1", {fk.frequency.size(), fk.wavenumber.size()}, {}};
  SignalReport::Array wavenumber{"wavenumber", "1/m", {fk.wavenumber.size()}, fk.wavenumber};
  for (std::size_t j = 0; j < fk.frequency.size(); ++j) {
    ridge.add_row(
        {fk.frequency[j], fk.ridge[j], fk.ridge[j] == 0 ? unknown : fk.frequency[j] / fk.ridge[j], fk.ridge_power[j]});
    power.values.insert(power.values.end(), fk.power[j].begin(), fk.power[j].end());
  }
  SignalReport report;
  report.text = fmt::format("{} probes over {:.6g} m along {:.4g},{:.4g},{:.4g}, {}\n", row.channels.size(),
                            row.distance.back(), row.along[0], row.along[1], row.along[2], band_text(request));
  report.text += fmt::format(
      "time of flight         {:10.1f} m/s, standard error {:.1f} m/s; similarity of the last probe {:.4f}\n",
      flight.speed, flight.standard_error, flight.similarity.back());
  report.text +=
      fmt::format("frequency, wave number {:10.1f} m/s, scatter over the band {:.1f} m/s\n", fk.speed, fk.scatter);
  report.figures = {{"time_of_flight_speed", flight.speed},
                    {"time_of_flight_standard_error", flight.standard_error},
                    {"wavenumber_speed", fk.speed},
                    {"wavenumber_scatter", fk.scatter}};
  report.tables.emplace_back("probes", std::move(probes));
  report.tables.emplace_back("ridge", std::move(ridge));
  report.arrays = {std::move(power), std::move(wavenumber)};
  return report;
}

}  // namespace railwave
