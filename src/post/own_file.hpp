#pragma once

#include <functional>
#include <optional>
#include <string>

#include "post/results_reader.hpp"

namespace railwave {

/// A kind of HDF5 file that a command writes.
struct OwnFormat {
  const char* name;     ///< its attribute `format`
  long version;         ///< `format_version`
  const char* command;  ///< what writes it, for complaints
};

/// Writes an HDF5 file, whole or not at all: format, results_file and title as attributes, and what `fill` adds. An
/// older file of the same format is replaced. Throws InputError if there is another file of that name, or if it cannot
/// be written.
void write_own_file(const std::string& path, const OwnFormat& format, const ResultsReader& results,
                    const std::function<void(const hdf5::Group&)>& fill);

/// Throws InputError if `file`, which a command is to write, is the results file that it reads.
void check_is_not(const std::string& results, const std::optional<std::string>& file);

/// Writes a table as text. Throws InputError if an HDF5 file of that name is there, which would be lost, or if it
/// cannot be written.
void write_table(const std::string& path, const std::string& text);

}  // namespace railwave
