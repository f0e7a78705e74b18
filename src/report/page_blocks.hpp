#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace railwave::page {

using Json = nlohmann::ordered_json;

/// The arrays of a page. Each becomes a block of text in the HTML file: its bytes, deflated (zlib) and written as
/// base64, which the page takes apart again by the browser's own DecompressionStream. Before that the first bytes of
/// all numbers are put together, then the second bytes, and so on, and whole numbers are replaced by their differences,
/// so that neighbours that are alike become short.
class PageBlocks {
 public:
  /// Adds numbers in single precision. @return how the page finds them: block, type, count
  Json add(const std::vector<double>& values);

  /// Adds whole numbers of 32 bits.
  Json add(const std::vector<std::uint32_t>& values);

  /// Adds numbers in 65535 even levels from the smallest to the largest of them: each is off by 1/131068 of that range
  /// at most. What is not finite is not known in the page. @return also `low` and `step`
  Json add_in_levels(const std::vector<double>& values);

  /// All blocks as elements of HTML.
  const std::string& html() const { return html_; }

 private:
  Json add_bytes(const std::vector<unsigned char>& bytes, const char* type, std::size_t count);
  std::string html_;
  int count_ = 0;
};

/// JSON as text that may stand in a script element of HTML, which it does not end. Numbers that are not finite are
/// null; bytes that are no UTF-8 become U+FFFD.
std::string text_for_html(const Json& json);

}  // namespace railwave::page
