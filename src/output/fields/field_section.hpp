#pragma once

#include <string>
#include <vector>

#include "output/fields/compressed_rows.hpp"
#include "output/fields/field_snapshot.hpp"
#include "output/fields/number_format.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/output_sets.hpp"

namespace railwave {

/// Group /fields/NAME or /beams/NAME of a results file: one output set, its mesh once and its fields at each output
/// time.
class FieldSection {
 public:
  /// `fields`: names of case/field_table.hpp. Beams have section forces and moments whatever is asked.
  FieldSection(const hdf5::Group& fields_group, const OutputSet& set, const std::vector<std::string>& fields,
               const NumberFormat& format);

  /// Names rows of one more output that can be compressed ahead.
  /// @param source outlives them
  void add_rows(const FieldSource& source, CompressedRows& rows) const;
  /// Writes the fields of one more output time, then its time: see ResultsWriter::flush().
  /// @param packed rows of them
  void add_values(const FieldSource& source, long step, const CompressedRows& packed = {});
  void add_time(double time) { times_.append(&time, 1); }

 private:
  struct Column {
    const FieldRow* field;
    hdf5::Dataset dataset;
  };
  std::vector<double> values_of(const Column& column, const FieldSource& source) const;
  void add_section_forces(const FieldSource& source);

  OutputSet set_;
  NumberFormat format_;
  hdf5::Dataset times_, steps_, forces_, moments_;
  std::vector<Column> columns_;  ///< those of nodes first
};

}  // namespace railwave
