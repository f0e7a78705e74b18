#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace railwave {

/// The bytes of a regular file. Throws InputError with the path and the reason when it can't be read.
std::string read_whole_file(const std::string& path);

/// A whole number with nothing beside it (a leading + is allowed); nothing when `text` is anything else.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// A finite decimal number with nothing beside it; the exponent's letter may be e, E, d or D (Fortran's double
/// precision). A number too small for a double becomes zero; nothing when `text` is anything else or too large.
std::optional<double> parse_real(std::string_view text);

/// `text` without blanks, tabs and carriage returns at its ends.
std::string_view trim(std::string_view text);

std::string lower_case(std::string_view text);

/// `text` made fit for a message: cut to 40 characters, unprintable bytes as \xNN.
std::string for_message(std::string_view text);

}  // namespace railwave
