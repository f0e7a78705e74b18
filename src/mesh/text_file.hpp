#pragma once

#include <string>
#include <string_view>

#include "case/number_text.hpp"

namespace railwave {

/// The bytes of a regular file. Throws InputError with the path and the reason when it can't be read.
std::string read_whole_file(const std::string& path);

/// `text` without blanks, tabs and carriage returns at its ends.
std::string_view trim(std::string_view text);

std::string lower_case(std::string_view text);

/// `text` made fit for a message: cut to 40 characters, unprintable bytes as \xNN.
std::string for_message(std::string_view text);

}  // namespace railwave
