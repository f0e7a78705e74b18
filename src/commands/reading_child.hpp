#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace railwave {

/// Runs a command that reads results files in a process of its own: HDF5 may crash, or go round in circles, in a
/// damaged file. To be called before any other thread is started and before HDF5 or Kokkos are used. The child prints
/// and writes what the command does; this process waits for it, and where a signal ended it says on stderr which files
/// are damaged and what to do.
/// @param command for people: "railwave signal"
/// @param files that it reads
/// @return the exit code, in both processes: the caller ends with it. What `work` throws passes through, in the child.
int in_reading_child(const std::string& command, const std::vector<std::string>& files,
                     const std::function<int()>& work);

/// The same for a look at files before something else is done with them.
/// @return the exit code to end with; nothing: `look` came to its end, go on (only in this process, the child is to
/// end)
std::optional<int> after_look_in_child(const std::string& command, const std::vector<std::string>& files,
                                       const std::function<void()>& look);

}  // namespace railwave
