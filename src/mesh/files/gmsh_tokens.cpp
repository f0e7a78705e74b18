#include "mesh/files/gmsh_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

std::string GmshTokens::where() const {
  // Once binary data have gone by, lines can't be counted.
  if (binary_) return fmt::format("{}: byte {}:", path_, start_);
  return fmt::format("{}:{}:", path_, line_);
}

void GmshTokens::fail(const std::string& text) const { throw InputError(where() + " " + text); }

std::string_view GmshTokens::text_line() {
  while (offset_ < bytes_.size()) {
    // A line break is counted when the next line begins, so that messages name the line of what was read.
    const auto end = std::min(bytes_.find('\n', offset_), bytes_.size());
    const auto line = trim(bytes_.substr(offset_, end - offset_));
    start_ = offset_;
    offset_ = end;
    if (!line.empty()) return line;
    if (offset_ < bytes_.size()) {
      ++offset_;
      ++line_;
    }
  }
  start_ = offset_;
  return {};
}

void GmshTokens::end_line() {
  offset_ = std::min(bytes_.find('\n', offset_), bytes_.size());
  if (offset_ < bytes_.size()) {
    ++offset_;
    ++line_;
  }
}

bool GmshTokens::skip_past(const std::string& ending) {
  auto found = bytes_.find("\n" + ending, offset_);
  if (found == std::string_view::npos) return false;
  found += 1 + ending.size();
  const auto skipped = bytes_.substr(offset_, found - offset_);
  line_ += std::count(skipped.begin(), skipped.end(), '\n');
  start_ = found - ending.size();
  offset_ = found;
  return true;
}

std::string_view GmshTokens::token(const char* what) {
  while (offset_ < bytes_.size() && is_blank(bytes_[offset_])) {
    if (bytes_[offset_] == '\n') ++line_;
    ++offset_;
  }
  start_ = offset_;
  while (offset_ < bytes_.size() && !is_blank(bytes_[offset_])) ++offset_;
  const auto result = bytes_.substr(start_, offset_ - start_);
  if (result.empty())
    fail(fmt::format("the file ends where the {} should stand: it was cut short; write it again", what));
  if (result[0] == '$')
    fail(fmt::format(
        "'{}' stands where the {} should: the section has fewer entries than its counts say; write the file "
        "again",
        for_message(result), what));
  return result;
}

template <typename Number>
Number GmshTokens::raw(const char* what) {
  start_ = offset_;
  if (bytes_.size() - offset_ < sizeof(Number))
    fail(fmt::format("the file ends inside the {}: it was cut short; write it again", what));
  Number value;
  std::memcpy(&value, bytes_.data() + offset_, sizeof(Number));
  offset_ += sizeof(Number);
  return value;
}

std::int32_t GmshTokens::raw_integer(const char* what) { return raw<std::int32_t>(what); }

std::int64_t GmshTokens::integer(const char* what) {
  if (binary_) return raw<std::int32_t>(what);
  const auto text = token(what);
  const auto value = parse_integer(text);
  if (!value || *value < std::numeric_limits<std::int32_t>::min() || *value > std::numeric_limits<std::int32_t>::max())
    fail(fmt::format("'{}' is no {}; a whole number is expected here", for_message(text), what));
  return *value;
}

std::int64_t GmshTokens::size(const char* what) {
  std::int64_t value = 0;
  if (binary_) {
    const auto unsigned_value = raw<std::uint64_t>(what);
    if (unsigned_value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      fail(fmt::format("{} is no {}; the file is damaged, write it again", unsigned_value, what));
    return static_cast<std::int64_t>(unsigned_value);
  }
  const auto text = token(what);
  if (const auto parsed = parse_integer(text); parsed && *parsed >= 0)
    value = *parsed;
  else
    fail(fmt::format("'{}' is no {}; a whole number of 0 or more is expected here", for_message(text), what));
  return value;
}

double GmshTokens::real(const char* what) {
  if (binary_) {
    const auto value = raw<double>(what);
    if (!std::isfinite(value))
      fail(fmt::format("the {} isn't a finite number; the file is damaged, write it again", what));
    return value;
  }
  const auto text = token(what);
  const auto value = parse_real(text);
  if (!value) fail(fmt::format("'{}' is no {}; a number is expected here", for_message(text), what));
  return *value;
}

void GmshTokens::expect_numbers(std::int64_t count, std::int64_t numbers, const char* what) const {
  const auto left = static_cast<std::int64_t>(bytes_.size() - offset_);
  // In ASCII a number takes a digit and a blank, but the last needs no blank.
  const std::int64_t smallest = binary_ ? 4 * numbers : 2 * numbers;
  if (count > (left + 1) / smallest)
    fail(fmt::format(
        "the header promises {} {}, but only {} bytes follow: the header is wrong or the file was cut short; "
        "write it again",
        count, what, left));
}

}  // namespace railwave
