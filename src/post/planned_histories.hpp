#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "case/scene.hpp"
#include "model/assembly.hpp"
#include "model/elements/history_sets.hpp"
#include "post/channel_name.hpp"

namespace railwave {

/// The histories that a run of a scene will write, as they are known before it: what read_history() would only miss
/// when the run has ended is found here.
class PlannedHistories {
 public:
  /// Makes the scene's meshes for it, whose contact zones have been placed. Throws InputError for names in
  /// output.history_sets that are in no mesh. Nothing: the meshes cannot be made.
  static std::optional<PlannedHistories> of(const scene::Scene& scene);

  /// How many channels read_history() will find. Throws InputError, saying what there is, where it would refuse.
  std::size_t count(const std::string& channel) const;

  /// Throws InputError unless the run writes the velocity of that set.
  void expect_velocity(const std::string& set) const;

 private:
  PlannedHistories(const scene::Scene& scene, const Assembly& assembly);
  void expect_written(const ChannelPlace& place) const;

  std::string case_path_;
  ChannelNames names_;
  std::vector<HistorySet> sets_;
  std::map<std::string, int> beam_elements_;
  std::map<std::string, bool> torque_;  ///< by load
};

}  // namespace railwave
