#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/output_place.hpp"
#include "post/results_reader.hpp"

namespace railwave {

/// A kind of HDF5 file that a command writes.
struct OwnFormat {
  const char* name;     ///< its attribute `format`
  long version;         ///< `format_version`
  const char* command;  ///< what writes it, for complaints

  FileKind kind() const;
};

/// Writes an HDF5 file, whole or not at all: format, results_file and title as attributes, and what `fill` adds. An
/// older file of the same format is replaced. Throws InputError if there is another file of that name (unless
/// --overwrite gave it), or if it cannot be written.
void write_own_file(const std::string& path, const OwnFormat& format, const ResultsReader& results,
                    const std::function<void(const hdf5::Group&)>& fill);

/// A table (CSV) that a command writes.
/// @param columns names of its first columns, without units, separated by commas: by its heading an older table is
/// known again
/// @param more what the name of each further column contains; empty: there is none
FileKind table_kind(const std::string& called, const std::string& columns, const std::string& more = "");

/// What a command that reads results files is asked to write: an option, if it is given.
struct WantedFile {
  const char* option;  ///< "--csv"
  const std::optional<std::string>& path;
  FileKind kind;
};

/// Before the work begins: throws InputError where one of the files must not be written, see OutputPlaces.
void check_wanted_files(const std::vector<std::string>& results, const std::vector<WantedFile>& files, bool overwrite);

/// Writes a table as text. Throws InputError if it cannot be written, or if what is there may not be replaced.
void write_table(const std::string& path, const std::string& text, const FileKind& kind);

}  // namespace railwave
