#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "post/results_reader.hpp"

namespace railwave {

/// One number against time.
struct HistoryChannel {
  std::string name;  ///< as the command line would call it
  std::string unit;  ///< m, m/s, m/s2, N, N m, J or 1
  std::vector<double> values;
  std::optional<Eigen::Vector3d> position;  ///< m, undeformed, of the set; older files do not tell it
};

/// Channels of one run at evenly spaced times.
struct HistorySeries {
  double start = 0;     ///< s, of the first value
  double interval = 0;  ///< s
  std::vector<HistoryChannel> channels;
  std::vector<std::string> notes;  ///< what was done to have them evenly spaced, for the user
  std::size_t length() const { return channels.empty() ? 0 : channels.front().values.size(); }
  double time(std::size_t i) const { return start + static_cast<double>(i) * interval; }
};

/// Samples that a series has at least.
inline constexpr std::size_t fewest_samples = 4;

/// What is read, and from when to when (s).
struct HistoryRequest {
  std::vector<std::string> channels;
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  bool average = false;  ///< all that one entry of `channels` finds becomes one channel, their mean
};

/// Reads channels of /history. They are called
///
///   SET.displacement.z, SET.velocity.x, SET.acceleration.0,1,0.05   a history set along an axis or along a vector
///   (made a unit one) contact.NAME.normal_force.size, contact.NAME.nodes_in_contact   "size" is the length of the
///   vector beam.NAME.moment.ELEMENT.y                                      elements count from 0 load.NAME.force.z of
///   a load, its total energy.kinetic
///
/// In SET, * stands for any letters and yields a channel for each set that it finds; names joined by + yield one, the
/// mean of them (thesis eq. 3.7; each set counts once, and is itself the mean by mass of its nodes).
///
/// The run's own samples are taken where they are evenly spaced. A last sample that comes early is left out. Where the
/// run changed its step the samples are moved to even times by cubic interpolation, and a note says so. Throws
/// InputError naming what there is: for a channel that is not there, fewer than four samples between the times asked
/// for, values that are not finite, times that do not ascend or have gaps of more than twice the usual distance.
HistorySeries read_history(const ResultsReader& results, const HistoryRequest& request);

/// A channel as it was sampled, and what it is of.
struct SampledChannel {
  HistoryChannel channel;
  std::string group, owner, quantity, component;  ///< see ChannelPlace; component: "x", "mises" or empty
};

/// All that a run sampled, but beams' forces: the run's own times, s, and at each of them the values, which may be not
/// finite where the run went wrong.
struct HistoryTable {
  std::vector<double> times;
  std::vector<SampledChannel> channels;
  std::vector<std::string> beams;  ///< whose forces and moments are left out
};

/// Reads every channel as it is in the file: vectors along x, y and z, stresses with von Mises' equivalent. Throws
/// InputError where the file is damaged.
HistoryTable read_history_table(const ResultsReader& results);

/// What read_history() knows in this file, for people: see ChannelNames::summary().
std::string history_summary(const ResultsReader& results);

/// Moves values at ascending `times` to start + i interval, i = 0 ... count-1, by the cubic through the two samples on
/// either side.
std::vector<double> resampled(const std::vector<double>& times, const std::vector<double>& values, double start,
                              double interval, std::size_t count);

}  // namespace railwave
