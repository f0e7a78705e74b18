#pragma once

#include <string>
#include <vector>

#include "output/hdf5/hdf5.hpp"

namespace railwave {

/// A column of a table: what docs/results-file.md calls it, and its unit ("1" of a mere number).
struct Column {
  std::string name, unit;
};

/// A cell of a CSV file: with commas or quotes it is put in quotes, as spreadsheets expect it.
std::string csv_text(const std::string& text);

/// Rows of numbers, for CSV and HDF5 alike. Not-a-number: not known; an empty cell in CSV.
class Table {
 public:
  explicit Table(std::vector<Column> columns);

  /// Throws std::logic_error if there are not as many as columns.
  void add_row(const std::vector<double>& values);

  const std::vector<Column>& columns() const { return columns_; }

  std::size_t row_count() const { return columns_.empty() ? 0 : values_.front().size(); }
  double& at(std::size_t row, const std::string& column) { return values_[place(column)][row]; }
  double at(std::size_t row, const std::string& column) const { return values_[place(column)][row]; }
  const std::vector<double>& values(const std::string& column) const { return values_[place(column)]; }

  /// The names of the columns, after one called "contact"; and the rows, after that contact's name. Columns whose unit
  /// is "row" link one table to another and are left out.
  std::string csv_heading() const;
  std::string csv_rows(const std::string& contact) const;

  /// All of it as CSV, with the units in the heading: "time [s],power [m2]". Columns that link are left out.
  std::string csv() const;

  /// A dataset for each column, its unit as its attribute `unit` and as the group's attribute of the column's name.
  void write(const hdf5::Group& group) const;

 private:
  std::size_t place(const std::string& column) const;
  std::string row_text(std::size_t row, std::string first) const;

  std::vector<Column> columns_;
  std::vector<std::vector<double>> values_;  ///< by column
};

}  // namespace railwave
