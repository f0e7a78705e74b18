#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace railwave {

/// What `railwave ensemble` was asked for.
struct EnsembleRequest {
  std::string case_file;
  std::vector<std::string> overrides;             ///< of all members
  std::vector<std::vector<std::string>> members;  ///< of each
  bool overwrite = false;
};

/// What became of the members.
struct EnsembleEnd {
  int completed = 0;
  int ended_early = 0;  ///< the monitor found something fatal, or a signal came
  int failed = 0;       ///< something was thrown, as when the disk is full
};

void add_ensemble_command(CLI::App& app, EnsembleRequest& request, const std::function<void()>& run);

/// Runs the members of an ensemble in this process, see run_together(). Each writes its own results, and what its run
/// reports to a text file beside them. `out` gets a line for each that ends.
/// Throws InputError before anything runs where one of them cannot be run.
EnsembleEnd run_ensemble(const EnsembleRequest& request, std::ostream& out);

}  // namespace railwave
