#pragma once

#include <functional>
#include <iosfwd>
#include <vector>

#include "sweep/study.hpp"

namespace railwave::sweep {

struct RunOptions {
  int jobs = 0;     ///< members side by side at most; 0: as many as there are processors. Memory may allow fewer
  int threads = 0;  ///< of each; 0: as many as processors are left over
  int retries = 2;  ///< further attempts at a member that was killed
  std::function<bool()> stopped = [] { return false; };  ///< asked several times a second
};

/// How the members stand when run_members() returns.
struct Tally {
  std::size_t completed = 0, broke_down = 0, refused = 0, unfinished = 0;  ///< unfinished: killed, failed or not run
  bool stopped = false;
};

/// How they stand now.
Tally tally_of(const Study& study, const std::vector<const Member*>& members);

/// Runs those of the members that have no row yet, each until it has one or was killed once more than `retries`. What
/// one of them does is of no consequence for the others. This is the place that decides how members run: here each is a
/// process of its own, several side by side (run_side_by_side()). Members that can share a process, as on a GPU, are to
/// be gathered here.
/// @param out a line for each member that has ended
Tally run_members(const Study& study, const std::vector<const Member*>& members, const RunOptions& options,
                  std::ostream& out);

/// How many members run at once, and with how many threads each.
struct Sharing {
  int jobs = 1, threads = 1;
};

/// Members side by side are as fast as threads within one or faster, so each has one thread while there are at least as
/// many members as processors; with fewer, what is left over goes to threads.
/// @param options with numbers above 0 for what the user has chosen
Sharing share_processors(int processors, std::size_t members, const RunOptions& options);

}  // namespace railwave::sweep
