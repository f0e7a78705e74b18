#include "sweep/overrides_of_members.hpp"

#include <fmt/format.h>

#include "case/complaints.hpp"
#include "case/document.hpp"
#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave::sweep {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> cells_of(const std::string& path, int line, const std::string& text) {
  std::vector<std::string> cells;
  std::string cell;
  bool quoted = false, was_quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted && c == '"' && at + 1 < text.size() && text[at + 1] == '"') {
      cell += text[++at];
    } else if (c == '"' && (quoted || trimmed(cell).empty())) {
      if (!quoted) cell.clear();
      quoted = !quoted;
      was_quoted = true;
    } else if (c == ',' && !quoted) {
      cells.push_back(was_quoted ? cell : trimmed(cell));
      cell.clear();
      was_quoted = false;
    } else if (!(was_quoted && !quoted && (c == ' ' || c == '\t' || c == '\r'))) {
      cell += c;
    }
  }
  if (quoted) throw InputError(fmt::format("{}:{}: a double quote is not closed on its line", path, line));
  cells.push_back(was_quoted ? cell : trimmed(cell));
  return cells;
}

void refuse_other_separators(const std::string& path, const CsvRows::value_type& heading) {
  for (const char* other : {";", "\t"})
    if (heading.cells.size() == 1 && heading.cells[0].find(other) != std::string::npos)
      throw InputError(fmt::format("{}:{}: the heading is one key, {}: columns are parted by commas", path,
                                   heading.line, for_message(heading.cells[0])));
}

}  // namespace

CsvRows read_csv(const std::string& path) {
  const std::string text = case_file::load_text(path);
  CsvRows rows;
  int line = 0;
  for (std::size_t at = text.rfind("\xef\xbb\xbf", 0) == 0 ? 3 : 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string one = text.substr(at, end - at);
    at = end + 1;
    ++line;
    const std::string content = trimmed(one);
    if (content.empty() || content[0] == '#') continue;
    rows.push_back({line, cells_of(path, line, one)});
    if (rows.size() == 1) refuse_other_separators(path, rows[0]);
    if (rows.back().cells.size() != rows.front().cells.size())
      throw InputError(
          fmt::format("{}:{}: has {} cells, the heading has {}; a cell with commas, such as a list, stands "
                      "in double quotes",
                      path, line, rows.back().cells.size(), rows.front().cells.size()));
  }
  if (rows.empty()) throw InputError(path + ": is empty; a heading of keys is wanted, and a row for each member");
  return rows;
}

}  // namespace railwave::sweep
