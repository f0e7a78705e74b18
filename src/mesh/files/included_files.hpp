#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/files/numbered_mesh.hpp"

namespace railwave {

/// The files of an input that include one another.
class IncludedFiles {
 public:
  /// Paths of the files opened are added to `files`, to which places refer.
  explicit IncludedFiles(std::vector<std::string>& files) : files_(files) {}

  /// The text of a file, without a byte order mark; its number is that of the last of `files` then. Throws InputError
  /// where it can't be read, is within itself, or is one too many.
  /// @param from where it is included; null: it is the first
  std::string open(const std::string& path, const FilePlace* from);

  int last() const { return static_cast<int>(files_.size()) - 1; }
  const std::string& path(int file) const { return files_[file]; }

  /// The file that included a file; -1: none.
  int includer(int file) const { return opened_[file].from; }

  /// "path:line:".
  std::string where(const FilePlace& place) const;

  /// Throws InputError where a line has a byte that no text has.
  /// @param kind what the file should be, as the message has it
  /// @param also bytes that it may have nevertheless
  void check_text(std::string_view line, const FilePlace& place, const char* kind, std::string_view also = "") const;

 private:
  struct Opened {
    std::string real_path;  // to notice a file that includes itself
    int from;               // the file that named it; -1: none
  };

  std::vector<std::string>& files_;
  std::vector<Opened> opened_;  // by number, as files_
  int includes_ = 0;
};

}  // namespace railwave
