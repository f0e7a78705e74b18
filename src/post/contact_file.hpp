#pragma once

#include <string>
#include <utility>
#include <vector>

#include "post/contact_tables.hpp"
#include "post/results_reader.hpp"

namespace railwave {

/// What `railwave contact --hdf5` writes.
FileKind contact_file_kind();

/// Writes the tables of every contact into an HDF5 file of their own (docs/results-file.md), whole or not at all. An
/// older file of this kind is replaced. Throws InputError if there is another file of that name, or if it cannot be
/// written.
/// @param contacts names and tables
/// @param surfaces of each the slave surface's name; read before, as a damaged file may end this process
void write_contact_file(const std::string& path, const ResultsReader& results,
                        const std::vector<std::pair<std::string, ContactTables>>& contacts,
                        const std::vector<std::string>& surfaces);

}  // namespace railwave
