#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/assembled_scene.hpp"
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

/// Hash of everything that a run's course and its results depend on: the case but for its title, its end, the monitor
/// and what is reported on the way, the mesh in the solver's order, the program's version.
std::string checkpoint_key(const AssembledScene& assembled, const std::string& program_version);

/// Where a case's checkpoint lies: unless it says so, results.h5 -> results.checkpoint.h5.
std::string checkpoint_path(const scene::Scene& scene);

/// From where a run goes on.
struct Restart {
  bool complete = false;             ///< the results are those of the whole run: nothing is left to do
  std::optional<RunState> state;     ///< unless complete
  std::vector<std::string> remarks;  ///< for people
};

/// Throws InputError as find_restart() does where the results that are to be added to are damaged, also in what was
/// written last. Nothing is done where there are none. HDF5 may crash in a damaged file: to be called in a process of
/// its own.
void check_can_be_extended(const std::string& results_path);

/// The newest good checkpoint that belongs to a results file. Throws InputError, saying what to do, where there is
/// none, and where the results are missing, unreadable, being written by another run, or another run's.
/// @param end of the run, s; results of a complete run are gone on with where that is later than theirs
Restart find_restart(const std::string& results_path, const CheckpointFile& checkpoint, double end);

}  // namespace railwave
