#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace railwave::page {

/// The arrays of a page. Each becomes a block of text in the HTML file: its bytes, deflated (zlib) and written as
/// base64, which the page takes apart again by the browser's own DecompressionStream. Before that the first bytes of
/// all numbers are put together, then the second bytes, and so on, and whole numbers are replaced by their differences,
/// so that neighbours that are alike become short.
class PageBlocks {
 public:
  /// Adds numbers in single precision. @return how the page finds them, as JSON: block, type, count
  std::string add(const std::vector<double>& values);

  /// Adds whole numbers of 32 bits.
  std::string add(const std::vector<std::uint32_t>& values);

  /// Adds numbers in 65535 even levels from the smallest to the largest of them: each is off by 1/131068 of that range
  /// at most. What is not finite is not known in the page. @return as JSON: also `low` and `step`
  std::string add_in_levels(const std::vector<double>& values);

  /// All blocks as elements of HTML.
  const std::string& html() const { return html_; }

 private:
  std::string add_bytes(const std::vector<unsigned char>& bytes, const char* type, std::size_t count,
                        const std::string& more = "");
  std::string html_;
  int count_ = 0;
};

/// A text as JSON that may stand in a script element of HTML; control characters are escaped.
std::string json_text(const std::string& plain);

/// A number as JSON; null where it is not finite.
std::string json_number(double value);

}  // namespace railwave::page
