#include "case/shared_files.hpp"

#include <filesystem>

namespace railwave {

namespace fs = std::filesystem;

std::string installed_file(const std::string& name) {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (failed) return "";
  return (program.parent_path().parent_path() / "share" / "railwave" / name).string();
}

std::vector<std::string> places_of(const std::string& name, const std::string& in_source) {
  std::vector<std::string> places;
  for (const std::string& place : {installed_file(name), in_source})
    if (!place.empty()) places.push_back(place);
  return places;
}

std::string first_present(const std::vector<std::string>& places) {
  std::error_code failed;
  for (const std::string& place : places)
    if (fs::exists(place, failed)) return place;
  return "";
}

std::string script_command(const std::string& script) {
  const bool installed = !first_present(places_of("scripts/" + script, "")).empty();
  return (installed ? "railwave-" : "scripts/") + script;
}

}  // namespace railwave
