#include "output/checkpoint_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "case/error.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/results_writer.hpp"

namespace railwave {
namespace {

struct ResultsThere {
  std::string run, key;
  double completed_until = -1;  ///< s, the end of a complete run
};

ResultsThere inspect(const std::string& path, bool last_too = false) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw InputError(fmt::format("--restart: there are no results {} to add to; run the case without --restart", path));
  try {
    const hdf5::File file = hdf5::File::open(path);
    const hdf5::Group root = file.root();
    if (last_too) root.check_last();
    if (!root.has_attribute("run")) throw std::runtime_error("no run of this version of the program wrote it");
    const bool completed = root.has_attribute("completed") && root.number_attribute("completed") != 0;
    return {root.text_attribute("run"), root.text_attribute("key"), completed ? root.number_attribute("end_time") : -1};
  } catch (const std::runtime_error& error) {
    throw InputError(
        fmt::format("--restart: the results {} cannot be added to: {}; run the case with --overwrite instead of "
                    "--restart, which replaces them",
                    path, error.what()));
  }
}

}  // namespace

void check_can_be_extended(const std::string& results_path) {
  std::error_code ignored;
  if (!std::filesystem::exists(results_path, ignored)) return;
  check_results_place(results_path);  // tells whether another run is writing them
  inspect(results_path, true);
}

Restart find_restart(const std::string& results_path, const CheckpointFile& checkpoint, double end) {
  Restart restart;
  const ResultsThere there = inspect(results_path);
  if (there.key.empty())
    throw InputError(fmt::format(
        "--restart: the results {} are those of an ensemble's member, whose state is not kept; run the case "
        "with --overwrite instead of --restart, which replaces them",
        results_path));
  if (there.key != checkpoint.key())
    throw InputError(
        fmt::format("--restart: the results {} are of another case, of this case before it was changed, or of another "
                    "version of the "
                    "program; run the case with --overwrite instead of --restart, which replaces them, or as it was",
                    results_path));
  if (there.completed_until >= end) {
    restart.complete = true;
    restart.remarks.push_back(fmt::format("nothing to do: {} holds the whole run", results_path));
    return restart;
  }
  CheckpointFile::Found found = checkpoint.find(there.run);
  restart.remarks = found.troubles;
  if (!found.state) {
    std::string why = fmt::format("--restart: there is no checkpoint {} of this run", checkpoint.path());
    for (const std::string& trouble : found.troubles) why += "; " + trouble;
    if (there.completed_until > 0)
      throw InputError(
          fmt::format("{}; the results hold all of it to t = {:.6g} s, and it can go on to {:.6g} s only if it was run "
                      "with --keep-state",
                      why, there.completed_until, end));
    throw InputError(why + "; run the case without --restart");
  }
  restart.remarks.push_back(
      fmt::format("goes on from {}: step {}, t = {:.6g} s", found.file, found.state->step, found.state->time));
  if (found.state->back_end != back_end_name())
    restart.remarks.push_back(
        fmt::format("that was computed on {}, this is {}: the results will not be the unbroken run's bit for bit",
                    found.state->back_end, back_end_name()));
  restart.state = std::move(found.state);
  return restart;
}

}  // namespace railwave
