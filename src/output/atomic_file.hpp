#pragma once

#include <string>

namespace railwave {

/// Writes a text file whole: under another name beside it first, then renamed, so that nobody ever sees half of it.
/// Throws std::runtime_error with the system's reason.
void write_whole_file(const std::string& path, const std::string& text);

}  // namespace railwave
