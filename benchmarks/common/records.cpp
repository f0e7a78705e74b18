#include "benchmarks/common/records.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace railwave::bench {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

}  // namespace

void Records::write() const {
  if (path_.empty()) return;
  std::vector<std::string> columns;
  for (const Row& row : rows_)
    for (const auto& cell : row.cells_)
      if (std::find(columns.begin(), columns.end(), cell.first) == columns.end()) columns.push_back(cell.first);

  std::ofstream file(path_);
  file << "# program: " << program_ << '\n';
  for (const auto& [name, value] : facts_) file << "# " << name << ": " << value << '\n';
  for (std::size_t c = 0; c < columns.size(); ++c) file << (c > 0 ? "," : "") << columns[c];
  file << '\n';
  for (const Row& row : rows_) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto cell =
          std::find_if(row.cells_.begin(), row.cells_.end(), [&](const auto& it) { return it.first == columns[c]; });
      file << (c > 0 ? "," : "") << (cell == row.cells_.end() ? "" : quoted(cell->second));
    }
    file << '\n';
  }
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path_ + "; does its folder exist, is there space?");
}

}  // namespace railwave::bench
