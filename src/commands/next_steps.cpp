#include "commands/check.hpp"

#include <filesystem>
#include <ostream>
#include <string>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/shared_files.hpp"
#include "output/checkpoint_file.hpp"
#include "output/results_writer.hpp"
#include "output/run_places.hpp"
#include "report/page.hpp"

namespace railwave {
namespace {

/// As it is typed in a shell.
std::string typed(const std::string& path) {
  if (path.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%") ==
      std::string::npos)
    return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

}  // namespace

void report_next_steps(const scene::Scene& scene, bool completed, std::ostream& out) {
  const std::string& results = scene.output.file;
  std::error_code failed;
  if (!std::filesystem::exists(results, failed)) return;  // it ended before its first output
  const std::string name = typed(results);
  out << fmt::format("results: {}\nnext:\n", results);
  const auto next = [&](const std::string& command, const char* what) {
    out << fmt::format("  {}  # {}\n", command, what);
  };
  if (!completed && std::filesystem::exists(checkpoint_path(scene), failed))
    next("railwave run " + typed(scene.path) + " --restart",
         "go on from the last checkpoint; with the same --set as before");
  if (page::has_page_template()) next("railwave report " + name, "all of it as one page for a browser");
  next(script_command("picture") + " " + name,
       scene.contacts.empty() ? "pictures of energies, beside the results"
                              : "pictures of contact patches, forces, energies, beside the results");
  if (!scene.contacts.empty()) next("railwave contact " + name, "patches, pressure, slip, creepages as a table");
  if (!scene.hammers.empty()) next("railwave frf " + name, "frequency responses and resonances");
  if (std::filesystem::exists(xdmf_path(results), failed))
    next("paraview " + typed(xdmf_path(results)), "fields in space; choose its 'XDMF Reader'");
}

void report_what_gets_lost(const scene::Scene& scene, std::ostream& out) {
  try {
    check_what_gets_lost(scene, {});
  } catch (const InputError& error) {
    out << "note: 'railwave run' would refuse: " << error.what() << '\n';
  }
}

}  // namespace railwave
