#include "post/table.hpp"

#include <cmath>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace railwave {
namespace {

bool links(const Column& column) { return column.unit == "row"; }

}  // namespace

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

Table::Table(std::vector<Column> columns) : columns_(std::move(columns)), values_(columns_.size()) {}

void Table::add_row(const std::vector<double>& values) {
  if (values.size() != columns_.size()) throw std::logic_error("a row of a table has another length than its columns");
  for (std::size_t c = 0; c < values.size(); ++c) values_[c].push_back(values[c]);
}

std::size_t Table::place(const std::string& column) const {
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (columns_[c].name == column) return c;
  throw std::logic_error("a table has no column " + column);
}

std::string Table::csv_heading() const {
  std::string text = "contact";
  for (const Column& column : columns_)
    if (!links(column)) text += ',' + column.name;
  return text + '\n';
}

/// The row's cells behind `first`, all with commas between.
std::string Table::row_text(std::size_t row, std::string text) const {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (links(columns_[c])) continue;
    const double value = values_[c][row];
    if (!std::isnan(value)) fmt::format_to(std::back_inserter(text), "{:.10g}", value);
    text += ',';
  }
  text.back() = '\n';
  return text;
}

std::string Table::csv_rows(const std::string& contact) const {
  const std::string first = csv_text(contact) + ',';
  std::string text;
  for (std::size_t row = 0; row < row_count(); ++row) text += row_text(row, first);
  return text;
}

std::string Table::csv() const {
  std::string text;
  for (const Column& column : columns_)
    if (!links(column)) text += csv_text(column.name + " [" + column.unit + ']') + ',';
  text.back() = '\n';
  for (std::size_t row = 0; row < row_count(); ++row) text += row_text(row, {});
  return text;
}

void Table::write(const hdf5::Group& group) const {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    group.write(columns_[c].name, values_[c], {values_[c].size()}, links(columns_[c]) ? "1" : columns_[c].unit);
    group.set_attribute(columns_[c].name, columns_[c].unit);
  }
}

}  // namespace railwave
