#include "mesh/files/text_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "case/error.hpp"
#include "case/memory.hpp"

namespace railwave {

namespace {

struct FilesRead {
  std::mutex mutex;
  std::set<std::pair<std::uint64_t, std::uint64_t>> files;  ///< device, inode
};

FilesRead& files_read() {
  static FilesRead all;
  return all;
}

void note_read(const std::string& path) {
  struct stat facts;
  if (stat(path.c_str(), &facts) != 0) return;
  const std::lock_guard<std::mutex> guard(files_read().mutex);
  files_read().files.insert({facts.st_dev, facts.st_ino});
}

}  // namespace

bool was_read(std::uint64_t device, std::uint64_t inode) {
  const std::lock_guard<std::mutex> guard(files_read().mutex);
  return files_read().files.count({device, inode}) != 0;
}

std::string read_whole_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(fmt::format("{}: no such file; check the path", path));
  if (!std::filesystem::is_regular_file(status))
    throw InputError(fmt::format("{}: not a file; give the path of a mesh file", path));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: can't be opened: {}", path, std::strerror(errno)));
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError(fmt::format("{}: can't be read: {}", path, error.message()));
  // What is made of each byte while the mesh is put together takes several more.
  constexpr double bytes_of_byte = 6;
  expect_memory(bytes_of_byte * static_cast<double>(size),
                fmt::format("{}: has {}; reading it needs", path, bytes_text(static_cast<double>(size))),
                "see whether this is the file you mean, or split or coarsen it");
  note_read(path);
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  // A file that another program is shortening meanwhile gives fewer bytes than it promised.
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string for_message(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result;
  for (std::size_t i = 0; i < text.size() && i < longest; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte >= 0x7f)
      result += fmt::format("\\x{:02x}", byte);
    else
      result += text[i];
  }
  return text.size() > longest ? result + "..." : result;
}

}  // namespace railwave
