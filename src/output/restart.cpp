#include "output/restart.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "case/error.hpp"
#include "output/hdf5.hpp"

namespace railwave {
namespace {

struct ResultsThere {
  std::string run, key;
  bool completed = false;
};

ResultsThere look_into(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw InputError(fmt::format("--restart: there are no results {} to add to; run the case without --restart", path));
  try {
    const hdf5::File file = hdf5::File::extend(path);  // mends what a kill left
    const hdf5::Group root = file.root();
    if (!root.has_attribute("run")) throw std::runtime_error("no run of this version of the program wrote it");
    return {root.text_attribute("run"), root.text_attribute("key"), root.has_attribute("completed") && root.number_attribute("completed") != 0};
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("--restart: the results {} cannot be added to: {}; run the case without --restart, which replaces them", path, error.what()));
  }
}

}  // namespace

Restart find_restart(const std::string& results_path, const CheckpointFile& checkpoint) {
  Restart restart;
  const ResultsThere there = look_into(results_path);
  if (there.key != checkpoint.key())
    throw InputError(fmt::format("--restart: the results {} are of another case, of this case before it was changed, or of another version of the "
                                 "program; run the case without --restart, which replaces them, or as it was",
                                 results_path));
  if (there.completed) {
    restart.complete = true;
    restart.remarks.push_back(fmt::format("nothing to do: {} holds the whole run", results_path));
    return restart;
  }
  CheckpointFile::Found found = checkpoint.find(there.run);
  restart.remarks = found.troubles;
  if (!found.state) {
    std::string why = fmt::format("--restart: there is no checkpoint {} of this run", checkpoint.path());
    for (const std::string& trouble : found.troubles) why += "; " + trouble;
    throw InputError(why + "; run the case without --restart");
  }
  restart.remarks.push_back(fmt::format("goes on from {}: step {}, t = {:.6g} s", found.file, found.state->step, found.state->time));
  if (found.state->back_end != back_end_name())
    restart.remarks.push_back(fmt::format("that was computed on {}, this is {}: the results will not be the unbroken run's bit for bit",
                                          found.state->back_end, back_end_name()));
  restart.state = std::move(found.state);
  return restart;
}

}  // namespace railwave
