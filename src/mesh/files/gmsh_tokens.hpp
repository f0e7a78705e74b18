#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/files/numbered_mesh.hpp"

namespace railwave {

/// The numbers of a Gmsh file one after another, alike for ASCII and binary, with the place of each.
/// Every reading call throws InputError at the end of the file or at what isn't a number.
class GmshTokens {
 public:
  /// `bytes` must outlive this.
  GmshTokens(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  void set_binary(bool binary) { binary_ = binary; }
  bool binary() const { return binary_; }

  /// "path:line:", or "path: byte N:" of the number read last from binary data.
  std::string where() const;
  /// The same for NumberedMesh.
  FilePlace place() const { return {0, binary_ ? static_cast<std::int64_t>(start_) : line_}; }

  /// The next line that isn't blank, trimmed: headings and what is ASCII in binary files too. Empty at the end of the
  /// file.
  std::string_view text_line();

  /// Skips what is left of this line, its break included: binary data begin at the next byte.
  void end_line();

  /// Skips to after the line `ending`; false when there is none.
  bool skip_past(const std::string& ending);

  std::int64_t integer(const char* what);      ///< 4 bytes in binary
  std::int64_t size(const char* what);         ///< 8 bytes in binary; never negative
  double real(const char* what);               ///< 8 bytes in binary
  std::int32_t raw_integer(const char* what);  ///< 4 bytes, whatever the mode

  /// Throws InputError unless `count` things of at least `numbers` numbers (of at least 4 bytes in binary) can still
  /// follow, so that no memory is allocated for the counts of a broken header.
  void expect_numbers(std::int64_t count, std::int64_t numbers, const char* what) const;

  [[noreturn]] void fail(const std::string& text) const;

 private:
  std::string_view token(const char* what);
  template <typename Number>
  Number raw(const char* what);

  std::string_view bytes_;
  std::string path_;
  bool binary_ = false;
  std::size_t offset_ = 0;  // of what comes next
  std::size_t start_ = 0;   // of what was read last
  std::int64_t line_ = 1;
};

}  // namespace railwave
