#pragma once

#include <string>

namespace railwave {

/// Adds a checksum over all bytes of a file behind its end, where HDF5 does not look, and brings it to the disk. Throws
/// std::runtime_error if the system refuses.
void seal(const std::string& path);

/// Throws std::runtime_error, saying what is wrong, unless the file is as it was sealed: HDF5 may crash on a damaged
/// file, so it is to see none.
void check_seal(const std::string& path);

}  // namespace railwave
