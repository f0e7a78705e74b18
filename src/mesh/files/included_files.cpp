#include "mesh/files/included_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

constexpr int deepest_include = 16;
constexpr int most_includes = 10000;

}  // namespace

std::string IncludedFiles::where(const FilePlace& place) const {
  return fmt::format("{}:{}:", files_[place.file], place.position);
}

std::string IncludedFiles::open(const std::string& path, const FilePlace* from) {
  const auto here = from ? where(*from) + " " : std::string();
  std::error_code error;
  const auto real_path = std::filesystem::weakly_canonical(path, error).string();
  int depth = 0;
  // By who named whom: a file that includes another in its last line has been read to its end by now.
  for (int file = from ? from->file : -1; file >= 0; file = opened_[file].from, ++depth)
    if (opened_[file].real_path == real_path)
      throw InputError(
          fmt::format("{}includes {}, which is being read already; a file can't include itself", here, path));
  if (depth > deepest_include)
    throw InputError(fmt::format("{}includes {}: more than {} files inside one another; put them into fewer", here,
                                 path, deepest_include));
  if (++includes_ > most_includes)
    throw InputError(
        fmt::format("{}includes {}: more than {} inclusions; put them into fewer files", here, path, most_includes));
  std::string text;
  try {
    text = read_whole_file(path);
  } catch (const InputError& problem) {
    throw InputError(here + (from ? "includes " : "") + problem.what());
  }
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);  // byte order mark of UTF-8
  opened_.push_back({real_path, from ? from->file : -1});
  files_.push_back(path);
  return text;
}

void IncludedFiles::check_text(std::string_view line, const FilePlace& place, const char* kind,
                               std::string_view also) const {
  for (char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 && c != '\t' && c != '\r' && c != '\f' && also.find(c) == std::string_view::npos)
      throw InputError(
          fmt::format("{} there is a byte 0x{:02x}, so this isn't a text file; give {} saved as plain text",
                      where(place), byte, kind));
  }
}

}  // namespace railwave
