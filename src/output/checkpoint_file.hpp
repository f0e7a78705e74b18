#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case/scene.hpp"
#include "solve/checkpoint/run_state.hpp"

namespace railwave {

/// A run's last state in a file, and the one before it: PATH and PATH.previous. A state is written whole as PATH.new,
/// brought to the disk and then given its name, so that a kill at any moment leaves a good one; each carries a checksum
/// over all it holds.
class CheckpointFile {
 public:
  /// @param path symbolic links are followed
  /// @param key of what determines the run, see checkpoint_key()
  CheckpointFile(const std::string& path, std::string key);

  const std::string& path() const { return path_; }
  const std::string& key() const { return key_; }

  /// Throws std::runtime_error when the disk refuses; what was there is there still.
  /// @param run name of the run in its results file
  void write(const RunState& state, const std::string& run) const;

  struct Found {
    std::optional<RunState> state;
    std::string file;                   ///< it was in
    std::vector<std::string> troubles;  ///< files that are there and of no use, and why
  };
  /// The newest good state of that run.
  Found find(const std::string& run) const;

  /// Takes both files away; what this program has not written stays.
  void remove() const;

 private:
  std::string path_, key_;
};

/// Hash of everything that a run's course and its results depend on: the case but for its title, its end, the watch and
/// what is told on the way, the mesh in the solver's order, the program's version.
std::string checkpoint_key(const Model& model, const std::string& program_version);

/// Where a case's checkpoint lies: unless it says so, results.h5 -> results.checkpoint.h5.
std::string checkpoint_path(const scene::Scene& scene);

}  // namespace railwave
