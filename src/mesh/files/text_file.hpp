#pragma once

#include <string>
#include <string_view>

#include "case/number_text.hpp"

namespace railwave {

/// The bytes of a regular file. Throws InputError with the path and the reason when it can't be read.
std::string read_whole_file(const std::string& path);

/// Whether read_whole_file() has read the file of this device and inode since the program began, by whatever name; a
/// mesh file may include others that the case does not name.
bool was_read(std::uint64_t device, std::uint64_t inode);

/// `text` without blanks, tabs and carriage returns at its ends.
std::string_view trim(std::string_view text);

std::string lower_case(std::string_view text);

/// `text` made fit for a message: cut to 40 characters, unprintable bytes as \xNN.
std::string for_message(std::string_view text);

}  // namespace railwave
