#include "post/history_series.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/field_table.hpp"
#include "model/fields.hpp"
#include "post/channel_name.hpp"

namespace railwave {
namespace {

/// Share of the usual distance by which samples may be off and still count as evenly spaced: far above the rounding of
/// times.
constexpr double even = 1e-6;

ChannelNames names_in(const hdf5::Group& history) {
  const auto names = [&](const char* group) {
    return history.has(group) ? history.group(group).names() : std::vector<std::string>{};
  };
  std::vector<std::string> moving, inside;
  for (const std::string& set : names("set")) {
    const hdf5::Group group = history.group("set").group(set);
    const auto any_of = [&](FieldRow::Place place) {
      const auto rows = fields_for(FieldRow::histories, place);
      return std::any_of(rows.begin(), rows.end(), [&](const FieldRow* row) { return group.has(row->name); });
    };
    if (any_of(FieldRow::Place::node)) moving.push_back(set);
    if (any_of(FieldRow::Place::element)) inside.push_back(set);
  }
  return {moving, names("contact"), names("beam"), names("energy"), names("load"), inside, names("prescribed_motion")};
}

hdf5::Group group_of(const hdf5::Group& history, const ChannelPlace& place) {
  return place.owner.empty() ? history.group(place.group) : history.group(place.group).group(place.owner);
}

/// One component of all samples of a tensor.
std::vector<double> component(const std::vector<double>& raw, const ChannelPlace& place) {
  std::vector<double> values(raw.size() / 6);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = place.component == ChannelPlace::von_mises ? von_mises(&raw[6 * i])
                                                           : raw[6 * i + static_cast<std::size_t>(place.component)];
  return values;
}

/// All samples of one place.
std::vector<double> read(const hdf5::Group& history, const ChannelPlace& place) {
  if (!group_of(history, place).has(place.quantity))
    throw InputError(fmt::format("channel '{}': the run did not write the {} of {}; {}", place.name(), place.quantity,
                                 place.owner,
                                 place.group == "set" ? "name it among the probe's quantities"
                                                      : "of forces there are force and work, of torques moment and "
                                                        "work"));
  const hdf5::Dataset dataset = group_of(history, place).dataset(place.quantity);
  const hdf5::Shape shape = dataset.shape();
  std::vector<double> raw;
  if (place.quantity == "nodes_in_contact" || place.quantity == "nodes_slipping") {
    const auto counts = dataset.read<long>();
    return {counts.begin(), counts.end()};
  }
  raw = dataset.read<double>();
  if (place.tensor) return component(raw, place);
  if (!place.vector) return raw;
  const std::size_t row = shape.size() == 3 ? 3 * static_cast<std::size_t>(shape[1]) : 3;
  if (3 * static_cast<std::size_t>(place.element) + 3 > row)
    throw InputError(fmt::format("channel '{}': the beam has {} elements, counted from 0", place.name(), row / 3));
  std::vector<double> values(raw.size() / row);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Eigen::Vector3d vector(raw.data() + i * row + 3 * static_cast<std::size_t>(place.element));
    values[i] = place.direction ? place.direction->dot(vector) : vector.norm();
  }
  return values;
}

HistoryChannel read_mean(const hdf5::Group& history, const std::vector<ChannelPlace>& places) {
  HistoryChannel channel;
  channel.unit = places.front().unit();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  bool placed = true;
  std::string owners;
  for (const ChannelPlace& place : places) {
    const auto values = read(history, place);
    if (channel.values.empty()) channel.values.assign(values.size(), 0.0);
    channel.values.resize(std::min(channel.values.size(), values.size()));
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      channel.values[i] += values[i] / static_cast<double>(places.size());
    const hdf5::Group group = group_of(history, place);
    placed = placed && place.group == "set" && group.has("position");
    // Stress holds at the element's centre, motion at the nodes.
    const FieldRow* row = find_field(place.quantity);
    const bool inside = row != nullptr && row->of_elements();
    const char* where = inside && group.has("element_centre") ? "element_centre" : "position";
    if (placed) position += read_vector(group, where) / static_cast<double>(places.size());
    owners += (owners.empty() ? "" : "+") + place.owner;
  }
  if (placed) channel.position = position;
  ChannelPlace named = places.front();
  named.owner = owners;
  channel.name = named.name();
  return channel;
}

/// Brings all channels to even times.
void space_evenly(HistorySeries& series, std::vector<double> times, const std::string& file) {
  const auto refuse = [&](const std::string& why) { throw InputError(fmt::format("histories of {}: {}", file, why)); };
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      refuse(
          fmt::format("time does not ascend from sample {} ({} s) to the next ({} s): the file is damaged, or put "
                      "together from several runs",
                      i - 1, times[i - 1], times[i]));
  std::vector<double> distances(times.size() - 1);
  for (std::size_t i = 0; i < distances.size(); ++i) distances[i] = times[i + 1] - times[i];
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2),
                   distances.end());
  const double usual = distances[distances.size() / 2];

  // The run's last sample is at its end, wherever that falls.
  const auto off = [&](std::size_t i, double interval) {
    return std::fabs(times[i + 1] - times[i] - interval) > even * interval;
  };
  if (times.size() > fewest_samples && times[times.size() - 1] - times[times.size() - 2] < (1 - even) * usual)
    times.pop_back();
  double least = usual, most = usual;
  bool uneven = false;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    least = std::min(least, times[i + 1] - times[i]);
    most = std::max(most, times[i + 1] - times[i]);
    uneven = uneven || off(i, usual);
  }
  if (most > 2 * usual)
    refuse(fmt::format("a gap of {:.4g} s among samples {:.4g} s apart; choose times without it by --from and --to",
                       most, usual));
  series.start = times.front();
  series.interval = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  if (uneven) {
    series.notes.push_back(
        fmt::format("the run changed its step: samples {:.6g} to {:.6g} s apart were moved to every {:.6g} s by cubic "
                    "interpolation",
                    least, most, series.interval));
  }
  for (HistoryChannel& channel : series.channels) {
    channel.values.resize(times.size());
    if (uneven) channel.values = resampled(times, channel.values, series.start, series.interval, times.size());
  }
}

HistorySeries read(const ResultsReader& results, const HistoryRequest& request) {
  const hdf5::Group history = results.history();
  const ChannelNames names = names_in(history);
  HistorySeries series;
  for (const std::string& text : request.channels) {
    auto found = find_channels(text, names, results.path());
    if (request.average) {
      std::vector<ChannelPlace> all;
      for (const auto& places : found) all.insert(all.end(), places.begin(), places.end());
      found = {all};
    }
    for (const auto& places : found) series.channels.push_back(read_mean(history, places));
  }
  auto times = history.dataset("time").read<double>();
  // A kill in the middle of a flush may leave arrays longer than the times.
  for (const HistoryChannel& channel : series.channels) times.resize(std::min(times.size(), channel.values.size()));
  const std::string whole =
      times.empty() ? "none at all" : fmt::format("they go from {:.6g} s to {:.6g} s", times.front(), times.back());
  const auto first = std::lower_bound(times.begin(), times.end(), request.from) - times.begin();
  const auto last = std::upper_bound(times.begin(), times.end(), request.to) - times.begin();
  if (last - first < static_cast<std::ptrdiff_t>(fewest_samples)) {
    std::string asked;
    if (std::isfinite(request.from)) asked += fmt::format(" from {} s", request.from);
    if (std::isfinite(request.to)) asked += fmt::format(" to {} s", request.to);
    throw InputError(fmt::format("{} has {} history samples{}, of which {} are wanted at least; {}", results.path(),
                                 std::max<std::ptrdiff_t>(0, last - first), asked, fewest_samples, whole));
  }
  times = {times.begin() + first, times.begin() + last};
  for (HistoryChannel& channel : series.channels) {
    channel.values = {channel.values.begin() + first, channel.values.begin() + last};
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      if (!std::isfinite(channel.values[i]))
        throw InputError(fmt::format(
            "channel '{}' of {} is no number at t = {:.6g} s: the run went wrong there; leave that out by --to",
            channel.name, results.path(), times[i]));
  }
  space_evenly(series, std::move(times), results.path());
  return series;
}

/// The channels of one dataset: a vector's along the axes, a tensor's components.
std::vector<ChannelPlace> places_of(const std::string& group, const std::string& owner, const std::string& quantity,
                                    const hdf5::Shape& shape) {
  const hsize_t components = shape.size() < 2 ? 1 : shape.back();
  std::vector<std::string> names{""};
  if (components == 3) names = {"x", "y", "z"};
  if (components == 6) names = {"xx", "yy", "zz", "xy", "yz", "zx"};
  if (quantity == "stress") names.emplace_back("mises");
  std::vector<ChannelPlace> places;
  for (std::size_t i = 0; i < names.size(); ++i) {
    ChannelPlace place;
    place.group = group, place.owner = owner, place.quantity = quantity;
    place.vector = components == 3;
    place.tensor = components == 6;
    place.component = static_cast<int>(i);
    if (place.vector) place.direction = Eigen::Vector3d::Unit(static_cast<int>(i));
    place.direction_text = names[i];
    places.push_back(place);
  }
  return places;
}

HistoryTable read_table(const ResultsReader& results) {
  const hdf5::Group history = results.history();
  HistoryTable table;
  table.times = history.dataset("time").read<double>();
  const auto add = [&](const std::string& group, const std::string& owner, const hdf5::Group& there,
                       const std::string& quantity) {
    for (const ChannelPlace& place : places_of(group, owner, quantity, there.dataset(quantity).shape())) {
      table.channels.push_back({read_mean(history, {place}), group, owner, quantity, place.direction_text});
      table.times.resize(std::min(table.times.size(), table.channels.back().channel.values.size()));
    }
  };
  const ChannelNames names = names_in(history);
  table.beams = names.beams;
  for (const std::string& energy : names.energies) add("energy", "", history.group("energy"), energy);
  for (const char* group : {"contact", "load", "prescribed_motion", "set"})
    for (const std::string& owner : history.has(group) ? history.group(group).names() : std::vector<std::string>{}) {
      const hdf5::Group there = history.group(group).group(owner);
      for (const std::string& name : there.names())
        if (group == std::string("set") ? find_field(name) != nullptr : name != "direction")
          add(group, owner, there, name);
    }
  for (SampledChannel& one : table.channels) one.channel.values.resize(table.times.size());
  return table;
}

template <class Read>
auto report_damage(const ResultsReader& results, const Read& read_it) {
  try {
    return read_it();
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("results file {} is damaged: histories: {}", results.path(), error.what()));
  }
}

}  // namespace

std::vector<double> resampled(const std::vector<double>& times, const std::vector<double>& values, double start,
                              double interval, std::size_t count) {
  if (times.size() < fewest_samples || times.size() != values.size())
    throw std::logic_error("cubic interpolation needs four samples");
  std::vector<double> result(count);
  std::size_t before = 0;  // the sample at or before the time
  for (std::size_t i = 0; i < count; ++i) {
    const double time = start + static_cast<double>(i) * interval;
    while (before + 2 < times.size() && times[before + 1] <= time) ++before;
    const std::size_t first = std::min(before > 0 ? before - 1 : 0, times.size() - 4);
    for (std::size_t a = first; a < first + 4; ++a) {
      double weight = 1;
      for (std::size_t b = first; b < first + 4; ++b)
        if (a != b) weight *= (time - times[b]) / (times[a] - times[b]);
      result[i] += weight * values[a];
    }
  }
  return result;
}

HistorySeries read_history(const ResultsReader& results, const HistoryRequest& request) {
  return report_damage(results, [&] { return read(results, request); });
}

HistoryTable read_history_table(const ResultsReader& results) {
  return report_damage(results, [&] { return read_table(results); });
}

std::string history_summary(const ResultsReader& results) { return names_in(results.history()).summary(); }

}  // namespace railwave
