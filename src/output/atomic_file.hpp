#pragma once

#include <string>

#include "output/file_kind.hpp"

namespace railwave {

/// Writes a text file whole: under another name beside it first, then renamed, so that nobody ever sees half of it.
/// Symbolic links are followed. Throws InputError if what is there may not be replaced by a file of that kind (see
/// output_place.hpp), std::runtime_error with the system's reason otherwise.
void write_whole_file(const std::string& path, const std::string& text, const FileKind& kind);

/// Files that have not got their names yet (PATH.new): taken away when the program is ended by a signal, or by a
/// library.
void note_unfinished(const std::string& path);
void forget_unfinished(const std::string& path);

/// Removes those that were noted and not forgotten. May be called from a signal's handler.
void remove_unfinished() noexcept;

/// Adds a checksum over all bytes of a file behind its end, where HDF5 does not look, and brings it to the disk. Throws
/// std::runtime_error if the system refuses.
void seal(const std::string& path);

/// Throws std::runtime_error, saying what is wrong, unless the file is as it was sealed: HDF5 may crash on a damaged
/// file, so it is to see none.
void check_seal(const std::string& path);

}  // namespace railwave
