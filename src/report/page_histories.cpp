#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "report/page.hpp"

namespace railwave::page {
namespace {

/// More than `most` samples as the smallest and the largest of each of most/2 stretches, in the order in which they
/// came; as many as `stretch_times` has.
std::vector<double> envelope(const std::vector<double>& values, std::size_t most) {
  if (values.size() <= most) return values;
  std::vector<double> thinned;
  const std::size_t stretches = most / 2;
  for (std::size_t n = 0; n < stretches; ++n) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(n * values.size() / stretches),
               to = values.begin() + static_cast<std::ptrdiff_t>((n + 1) * values.size() / stretches);
    const auto [low, high] = std::minmax_element(from, to);
    thinned.push_back(low < high ? *low : *high);
    thinned.push_back(low < high ? *high : *low);
  }
  return thinned;
}

/// Where the values of envelope() are drawn: at the first and the last time of each stretch.
std::vector<double> stretch_times(const std::vector<double>& times, std::size_t most) {
  if (times.size() <= most) return times;
  std::vector<double> thinned;
  const std::size_t stretches = most / 2;
  for (std::size_t n = 0; n < stretches; ++n) {
    thinned.push_back(times[n * times.size() / stretches]);
    thinned.push_back(times[(n + 1) * times.size() / stretches - 1]);
  }
  return thinned;
}

}  // namespace

Section history_section(const HistoryTable& history, const Limits& limits, PageBlocks& blocks) {
  Section section;
  section.there.samples = history.times.size();
  Json channels = Json::array();
  for (const SampledChannel& one : history.channels)
    channels.push_back(Json{{"name", one.channel.name},
                            {"unit", one.channel.unit},
                            {"group", one.group},
                            {"owner", one.owner},
                            {"quantity", one.quantity},
                            {"component", one.component},
                            {"values", blocks.add(envelope(one.channel.values, limits.samples))}});
  const std::vector<double> times = stretch_times(history.times, limits.samples);
  section.json = {
      {"time", blocks.add(times)}, {"samples", history.times.size()}, {"shown", times.size()}, {"channels", channels}};
  if (times.size() < history.times.size())
    section.notes.push_back(
        fmt::format("histories: {} samples are drawn as the smallest and the largest value of {} stretches of time",
                    history.times.size(), times.size() / 2));
  if (!history.beams.empty())
    section.notes.push_back(fmt::format(
        "histories of the forces in {} beams are left out; 'railwave signal' reads them", history.beams.size()));
  return section;
}

}  // namespace railwave::page
