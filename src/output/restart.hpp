#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/checkpoint_file.hpp"

namespace railwave {

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
