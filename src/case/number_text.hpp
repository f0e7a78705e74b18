#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as users write them. None of this depends on the locale: the decimal sign is a point wherever the program
/// runs.
namespace railwave {

/// A finite decimal number with nothing beside it; the exponent's letter may be e, E, d or D (Fortran's double
/// precision). A number too small for a double becomes zero; nothing when `text` is anything else or too large.
std::optional<double> parse_real(std::string_view text);

/// A whole number with nothing beside it (a leading + is allowed); nothing when `text` is anything else.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// The number with which `text` begins, a decimal point included, but no sign of what follows: "5.25abc" begins
/// with 5.25. For sorting names by the numbers in them. 0 where it begins with none.
double leading_real(std::string_view text);

/// Why `text`, which parse_real does not read, is no number, and what to write instead: "has a decimal comma; write
/// 0.5".
std::string why_no_number(std::string_view text);

/// Text that is meant as a number, well written or not: it begins with a digit, perhaps behind a quote, a sign or a
/// point, or is one of nan, inf and infinity.
bool looks_like_number(std::string_view text);

}  // namespace railwave
