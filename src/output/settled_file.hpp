#pragma once

#include <string>

#include "model/assembled_scene.hpp"
#include "solve/statics/static_state.hpp"

namespace railwave {

/// Settled states as HDF5 files beside the results, or in the folder that settle.cache_folder names. The name has a
/// hash of everything that the static state can depend on: the case but for times, outputs and initial velocities, the
/// mesh in the solver's order, precision, program version. A file is written whole under another name first; it says
/// how its state was found and carries a checksum. Scenes that come from no case file keep nothing.
class SettledFiles : public SettledStates {
 public:
  explicit SettledFiles(std::string program_version) : version_(std::move(program_version)) {}

  Found find(const AssembledScene& assembled) override;
  std::string keep(const AssembledScene& assembled, const StaticState& state) override;

  /// Where a model's state lies, or would lie.
  std::string path(const AssembledScene& assembled) const;

 private:
  std::string key(const AssembledScene& assembled) const;

  std::string version_;
};

}  // namespace railwave
