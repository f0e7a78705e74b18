#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "sweep/study.hpp"

namespace railwave::sweep {

/// What `railwave sweep` is asked for.
struct SweepRequest {
  std::string study;
  int jobs = 0, threads = 0;           ///< 0: as the machine has
  std::optional<int> retries;          ///< in place of the study's
  std::optional<std::string> members;  ///< "3,17-20": only these
  std::optional<std::string> job;      ///< "2/8": a share of them
  bool collect = false;                ///< nothing is run: tables and pictures of what is there
  bool dry_run = false;                ///< nothing is run or written: what would be
  bool pictures = true;
  std::optional<int> slurm;  ///< jobs of an array that is written and submitted
  bool snakemake = false;    ///< a Snakefile is written
};

/// Runs a study and writes its tables, then its pictures where all of it was asked for.
/// @param stopped whether a signal asked for the end; asked several times a second
/// @param pictures draws those of a table (HDF5); does not throw
/// @return the exit code of docs/commands.md
int sweep_command(const SweepRequest& request, const std::function<bool()>& stopped,
                  const std::function<void(const std::string& table)>& pictures, std::ostream& out);

/// Writes the scripts of an array of jobs, and of one that writes the tables after them, and submits both to Slurm.
/// Throws std::runtime_error where Slurm does not take them.
/// @param dry_run prints them instead
int hand_over_to_slurm(const Study& study, int jobs, bool dry_run, std::ostream& out);

/// Writes a Snakefile with a rule for each member and one for the tables, and says how it is run.
int hand_over_to_snakemake(const Study& study, bool dry_run, std::ostream& out);

}  // namespace railwave::sweep
