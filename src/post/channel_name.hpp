#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace railwave {

/// Where in /history a channel's numbers are.
struct ChannelPlace {
  std::string group;     ///< set, contact, beam, load, prescribed_motion or energy
  std::string owner;     ///< the set's, contact's, beam's, load's or motion's name; empty: energy
  std::string quantity;  ///< the dataset
  int element = 0;       ///< of a beam
  bool vector = false;   ///< three numbers a sample, of which `direction` takes one
  bool tensor = false;   ///< six numbers a sample, of which `component` takes one
  int component = 0;     ///< 0 to 5: xx, yy, zz, xy, yz, zx; `von_mises`: sqrt(3/2) times the size of the deviator
  static constexpr int von_mises = 6;
  std::optional<Eigen::Vector3d> direction;  ///< unit; absent: the length of the vector
  std::string direction_text;                ///< or the component's name

  std::string name() const;  ///< as the command line calls it
  std::string unit() const;
};

/// What a file has: names of its sets with motion, contacts, beams, energies and loads, of sets with stress or strain,
/// and of prescribed motions.
struct ChannelNames {
  std::vector<std::string> sets, contacts, beams, energies, loads, element_sets = {}, prescribed_motions = {};

  /// Every channel without its direction.
  std::vector<std::string> all() const;

  /// What one may ask for, in a few lines: long lists of names are cut short.
  std::string summary() const;
};

/// Finds what read_history() calls `text`: one list of places for each channel, whose mean it is. Throws InputError.
/// @param file the results file, for complaints
std::vector<std::vector<ChannelPlace>> find_channels(const std::string& text, const ChannelNames& names,
                                                     const std::string& file);

/// Whether `name` is `pattern`, whose stars stand for any letters.
bool matches_pattern(const std::string& pattern, const std::string& name);

/// By alphabet, but numbers by their value: row_2 comes before row_10.
bool in_number_order(const std::string& a, const std::string& b);

}  // namespace railwave
