#include <filesystem>
#include <fstream>
#include <iterator>

#include "case/document.hpp"
#include "case/error.hpp"
#include "case/suggest.hpp"

namespace railwave::case_file {
namespace {

namespace fs = std::filesystem;

std::string nearest_case(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code ignored;
  const auto folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    if (entry->path().extension() == ".toml") names.push_back(entry->path().filename().string());
  }
  const auto near = nearest_name(path.filename().string(), names);
  return near.empty() ? "" : "; did you mean '" + (path.parent_path() / near).string() + "'?";
}

}  // namespace

std::string load_text(const std::string& path) {
  constexpr std::uintmax_t largest = 16u << 20;
  std::error_code failed;
  const auto status = fs::status(path, failed);
  if (path.empty()) throw InputError("no case file was named; give one such as cases/rolling.toml");
  if (!fs::exists(status)) throw InputError(path + ": there is no such file" + nearest_case(path));
  if (fs::is_directory(status))
    throw InputError(path + ": is a folder; give a case file in it, such as " + path + "/NAME.toml");
  if (!fs::is_regular_file(status))
    throw InputError(path +
                     ": is a pipe, device or socket, which may give no end of text or none; give a case file, such as "
                     "cases/rolling.toml");
  if (fs::file_size(path, failed) > largest) {
    throw InputError(path +
                     ": has more than 16 MiB, too large for a case file; meshes and results are named in a case, not "
                     "given instead of it");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": cannot be opened; check that you may read it");
  std::string text;
  char piece[65536];
  while (file.read(piece, sizeof piece) || file.gcount() > 0) {
    text.append(piece, static_cast<std::size_t>(file.gcount()));
    if (text.size() > largest) throw InputError(path + ": has more than 16 MiB, too large for a case file");
  }
  if (file.bad()) throw InputError(path + ": cannot be read");
  if (text.rfind("\x89HDF", 0) == 0)
    throw InputError(path + ": is an HDF5 file, perhaps results of a run; give the case file (TOML)");
  if (text.find('\0') != std::string::npos)
    throw InputError(path + ": is not text; a case file is TOML, such as cases/rolling.toml");
  return text;
}

}  // namespace railwave::case_file
