#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace railwave::bench {

/// Rows of named values, written as CSV under the facts about the machine (lines that begin with '#', "# name: value").
/// Rows need not have the same columns. report.py reads these files.
class Records {
 public:
  class Row {
   public:
    Row& set(const std::string& column, const std::string& value) {
      cells_.emplace_back(column, value);
      return *this;
    }
    Row& set(const std::string& column, const char* value) { return set(column, std::string(value)); }
    Row& set(const std::string& column, double value) { return set(column, fmt::format("{:.6g}", value)); }
    Row& set(const std::string& column, int value) { return set(column, std::to_string(value)); }
    Row& set(const std::string& column, long value) { return set(column, std::to_string(value)); }

   private:
    friend class Records;
    std::vector<std::pair<std::string, std::string>> cells_;
  };

  /// @param program e.g. "throughput"; @param path of the CSV file, empty: none is written
  Records(std::string program, std::string path, std::vector<std::pair<std::string, std::string>> facts)
      : program_(std::move(program)), path_(std::move(path)), facts_(std::move(facts)) {}

  Row& add() { return rows_.emplace_back(); }
  void fact(const std::string& name, const std::string& value) { facts_.emplace_back(name, value); }

  /// Writes the file; throws std::runtime_error when it cannot.
  void write() const;

 private:
  std::string program_, path_;
  std::vector<std::pair<std::string, std::string>> facts_;
  std::vector<Row> rows_;
};

}  // namespace railwave::bench
