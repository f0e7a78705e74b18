#pragma once

#include <functional>
#include <vector>

#include "output/hdf5/hdf5.hpp"

namespace railwave {

/// Rows of an output of fields that are compressed before HDF5 is asked to write them: on several threads, and while
/// other runs of the process use HDF5, which one at a time may. Longer rows, of several chunks, are not among them:
/// HDF5's wrapper compresses those itself, a few chunks at a time.
class CompressedRows {
 public:
  /// Values of a row; any thread may ask for them.
  using Values = std::function<std::vector<double>()>;

  /// Takes note of a row, unless HDF5 is to compress it.
  /// @param dataset has its place until the row is written
  void add(const hdf5::Dataset& dataset, Values values);

  /// Compresses the rows. One for which there is no memory, or whose values are not to be had, is left out.
  /// @param threads that work on them, this one among them
  void pack(int threads);

  /// Writes a dataset's row. @return false: it has none here
  bool append_to(hdf5::Dataset& dataset) const;

 private:
  struct Row {
    const hdf5::Dataset* dataset;
    Values values;
    hdf5::PackedRow packed;  ///< empty: not yet, or left out
  };
  std::vector<Row> rows_;
};

}  // namespace railwave
