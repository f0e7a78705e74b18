#pragma once

#include <map>
#include <optional>
#include <string>

namespace railwave::hdf5 {

/// Short texts and whole numbers among the attributes of an HDF5 file's root.
struct RootAttributes {
  std::map<std::string, std::string> texts;
  std::map<std::string, long> numbers;

  std::string text(const std::string& name) const;  ///< empty: there is none
  long number(const std::string& name, long otherwise) const;
};

/// Reads them from the bytes of the file, without the HDF5 library: a damaged file or one of another program may crash
/// that. Knows the layouts that this program writes and wrote (superblocks 0 to 3, object headers 1 and 2, attributes
/// in the header); of any other file it finds no attributes. Every address and length is checked. The file is not
/// changed, also where a killed run left a journal in it. Layout: HDF5 File Format Specification 3.0, sections II.A,
/// III.E, IV.A.1, IV.A.2.m.
/// @return nothing: it is no HDF5 file, or may not be read. The path must be that of a regular file.
std::optional<RootAttributes> read_root_attributes(const std::string& path);

}  // namespace railwave::hdf5
