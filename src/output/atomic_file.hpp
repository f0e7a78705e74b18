#pragma once

#include <string>

#include "output/file_kind.hpp"

namespace railwave {

/// Writes a text file whole: under another name beside it first, then renamed, so that nobody ever sees half of it.
/// Symbolic links are followed. Throws InputError if what is there may not be replaced by a file of that kind (see
/// output_place.hpp), std::runtime_error with the system's reason otherwise.
void write_whole_file(const std::string& path, const std::string& text, const FileKind& kind);

}  // namespace railwave
