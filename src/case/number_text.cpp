#include "case/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace railwave {
namespace {

constexpr std::size_t longest_number = 63;

bool digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// How many characters from `at` on are digits.
std::size_t digits(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && digit(text[end])) ++end;
  return end - at;
}

/// Length of the decimal number with which the text begins: sign, digits, point, exponent. 0: it begins with none.
std::size_t number_length(std::string_view text) {
  std::size_t at = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  const std::size_t before = digits(text, at);
  at += before;
  std::size_t behind = 0;
  if (at < text.size() && text[at] == '.') {
    behind = digits(text, at + 1);
    if (before + behind > 0) at += 1 + behind;
  }
  if (before + behind == 0) return 0;
  if (at < text.size() && (lower(text[at]) == 'e' || lower(text[at]) == 'd')) {
    const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '+' || text[at + 1] == '-') ? 1 : 0;
    if (const std::size_t power = digits(text, at + 1 + sign); power > 0) at += 1 + sign + power;
  }
  return at;
}

bool not_finite_by_name(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  std::string name(text);
  std::transform(name.begin(), name.end(), name.begin(), [](char c) { return lower(c); });
  return name == "nan" || name == "inf" || name == "infinity" || name == "1.#inf" || name == "1.#qnan";
}

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

std::optional<double> parse_real(std::string_view text) {
  char buffer[longest_number];
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  if (text.empty() || text.size() > longest_number) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i) buffer[i] = lower(text[i]) == 'd' ? 'e' : text[i];
  const std::string_view number(buffer, text.size());

  double value = 0;
  const auto result = std::from_chars(number.data(), number.data() + number.size(), value);
  if (result.ptr != number.data() + number.size() || result.ec == std::errc::invalid_argument) return std::nullopt;
  // from_chars doesn't tell too large from too small. In so few characters only an exponent's sign makes a number too
  // small.
  if (result.ec == std::errc::result_out_of_range) {
    const auto exponent = number.find_first_of("eE");
    const bool small =
        exponent != std::string_view::npos && exponent + 1 < number.size() && number[exponent + 1] == '-';
    return small ? std::optional<double>(0) : std::nullopt;
  }
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

double leading_real(std::string_view text) { return parse_real(text.substr(0, number_length(text))).value_or(0); }

bool looks_like_number(std::string_view text) {
  while (!text.empty() && (text[0] == '"' || text[0] == '\'')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == '"' || text.back() == '\'')) text.remove_suffix(1);
  if (not_finite_by_name(text)) return true;
  std::size_t at = 0;
  while (at < text.size() && at < 2 && (text[at] == '+' || text[at] == '-' || text[at] == '.' || text[at] == ',')) ++at;
  return at < text.size() && digit(text[at]);
}

std::string why_no_number(std::string_view text) {
  if (text.empty()) return "is empty; write a number, such as 0.5";
  if (text.front() == '"' || text.front() == '\'') return "stands in quotes; write the number without them";
  if (not_finite_by_name(text)) return "is no finite number";
  if (text.size() > 2 && text[0] == '0' && lower(text[1]) == 'x') return "is hexadecimal; write the number in decimal";
  const std::size_t length = number_length(text);
  if (length == text.size())
    return text.size() > longest_number
               ? fmt::format("has {} characters, at most {} are read", text.size(), longest_number)
               : "is too large; at most 1.79e308 can be computed with";
  if (const auto comma = text.find(','); comma != std::string_view::npos) {
    std::string mended(text);
    mended[comma] = '.';
    if (text.find(',', comma + 1) == std::string_view::npos && parse_real(mended))
      return fmt::format("has a comma in it: a decimal comma? then write {}; thousands are not separated", mended);
    return "has commas in it; write a decimal point, and thousands without separators";
  }
  for (const char c : text)
    if (static_cast<unsigned char>(c) >= 0x80)
      return "has characters other than plain ones, perhaps a typographic minus or blank; write it as -0.5";
  if (length == 0) return "is no number; write one such as 0.5 or 5e-1";
  if (text[length] == '.') return "has more than one decimal point";
  const auto behind = text.find_first_not_of(" \t", length);
  if (behind != std::string_view::npos && (digit(text[behind]) || text[behind] == '-' || text[behind] == '+' ||
                                           text[behind] == '\'' || text[behind] == '_'))
    return "has more than one number in it; write one, thousands without separators";
  return "has something behind the number; write the number alone, a unit at most in the line of names";
}

}  // namespace railwave
