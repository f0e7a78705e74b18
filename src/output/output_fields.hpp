#pragma once

#include <string>

namespace railwave {

/// A dataset that the program writes: where, its values an entry, its unit.
struct OutputField {
  const char* place;  ///< path in the file; * stands for a name
  int components;     ///< values of an entry (a node, a cell, a sample); 0: by what it is of
  const char* unit;   ///< SI; "1" of numbers, counts and shares
};

/// The one table of datasets in results, model, mode and fault files, from which each gets its attribute `unit`. Files
/// of columns (contact solutions, signals, responses, decay rates) have units of their own. Null for a dataset that is
/// none of these, as in checkpoints.
/// @param path e.g. /history/set/rail.middle/stress
const OutputField* output_field(const std::string& path);

/// Unit of the dataset of that path; empty where the table has none.
std::string unit_of(const std::string& path);

/// Values of an entry of one of the fields that output.fields names.
int components_of(const std::string& field);

}  // namespace railwave
