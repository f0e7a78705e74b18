#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/complaints.hpp"
#include "case/document.hpp"

namespace railwave::sweep {

/// A key of the case with its value.
struct Override {
  std::string key;
  case_file::Node value;
  std::string origin;  ///< where it stands: "study.toml:12"
};

/// In the order in which they are to replace what the case says.
using Overrides = std::vector<Override>;

/// The unit of a key such as "time.end" or "parts.wheel.position[1]"; "1" of a mere number and of what is no key.
std::string unit_of_key(const std::string& key);

/// The keys of a table of the study. Written with quotes, "contacts.tread.friction" = 0.3, or without, which makes
/// tables in tables: both are the same key.
/// @param path of the study file
Overrides keys_of(const case_file::Node& table, const std::string& path);

/// What a study says of its members; each of the three may be missing.
struct MemberSources {
  std::vector<Overrides> list;  ///< [[list]]
  std::vector<Overrides> rows;  ///< of the CSV file that `table` names
  std::vector<Overrides> grid;  ///< [grid]: for each key one entry for each of its values
};

/// Reads [[list]], `table` and [grid] of a study; adds to the complaints what is wrong.
/// @param path of the study file, from whose folder the table's name counts
MemberSources read_member_sources(const case_file::Node& study, const std::string& path,
                                  case_file::Complaints& complaints);

/// The keys that differ between members, in the order of list, table, grid, each once.
std::vector<std::string> keys_of(const MemberSources& sources);

/// Every combination of an entry of the list, a row of the table and a point of the grid; the grid's last key changes
/// first. One member without overrides where there is none of them. Throws InputError for more than `most`.
std::vector<Overrides> combinations(const MemberSources& sources, double most);

/// A line of a CSV file that is neither empty nor a remark (#).
struct CsvRow {
  int line = 0;
  std::vector<std::string> cells;  ///< without blanks at their ends, and without quotes
};
using CsvRows = std::vector<CsvRow>;

/// Reads a CSV file: commas between cells; a cell with commas stands in double quotes, in which "" is a quote. Throws
/// InputError: no such file, empty, a quote that is not closed, or rows of another length than the first.
CsvRows read_csv(const std::string& path);

}  // namespace railwave::sweep
