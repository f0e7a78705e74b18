#include "case/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/complaints.hpp"
#include "case/error.hpp"
#include "case/number_text.hpp"

namespace railwave {
namespace {

using Cells = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "'" + case_file::printable(std::string(text), longest) + "'";
}

/// What separates the columns of a line; 0: there is one column only.
char separator_of(std::string_view line) {
  for (const char c : {';', '\t', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return line.find(' ') != std::string_view::npos ? ' ' : '\0';
}

const char* name_of(char separator) {
  return separator == ';'    ? "semicolons"
         : separator == '\t' ? "tabs"
         : separator == ','  ? "commas"
         : separator == ' '  ? "blanks"
                             : "nothing";
}

Cells split(std::string_view line, char separator) {
  Cells cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const auto end = std::min(separator == '\0' ? line.size() : line.find(separator, begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
    // Several blanks are one separator.
    while (separator == ' ' && begin < line.size() && line[begin] == ' ') ++begin;
  }
  return cells;
}

std::string count_text(std::size_t count) {
  constexpr const char* words[] = {"no", "one", "two", "three"};
  return count < 4 ? words[count] : std::to_string(count);
}

/// The words of a name, without brackets and the like: "time [ms]" is time and ms. A letter of UTF-8 such as a micro
/// sign belongs to a word.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    if (letter)
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

class TableReader {
 public:
  TableReader(const std::string& path, const std::vector<TableColumn>& columns, TableNames names)
      : path_(path), columns_(columns), names_(names) {
    for (const TableColumn& column : columns) wanted_ += (wanted_.empty() ? "" : ",") + column.name;
  }

  /// The line's values; false: it is empty, a remark or names.
  bool read(int number, std::string_view line, std::vector<double>& values) {
    line_ = number;
    line = trimmed(line);
    if (line.empty() || line[0] == '#' || line[0] == '%') return false;
    const char separator = separator_of(line);
    const Cells cells = split(line, separator);
    if (first_line_ == 0) {
      if (names_ == TableNames::must_stand && !named_) {
        take_needed_names(line, cells);
        return false;
      }
      if (std::none_of(cells.begin(), cells.end(), looks_like_number)) {
        check_names(cells);
        return false;
      }
      first_line_ = number;
      separator_ = separator;
    }
    if (std::none_of(cells.begin(), cells.end(), looks_like_number) && !line.empty() &&
        std::any_of(cells.begin(), cells.end(), [](auto cell) { return !cell.empty(); }))
      refuse(fmt::format("{} is text among numbers; write # before a remark, and names before the first number",
                         quoted(line)));
    read_values(line, separator, cells, values);
    return true;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_, line_, what));
  }

 private:
  std::string column_text(std::size_t c) const {
    return fmt::format("column {} ({}{})", c + 1, columns_[c].name,
                       columns_[c].unit.empty() ? "" : " in " + columns_[c].unit);
  }

  void read_values(std::string_view line, char separator, const Cells& cells, std::vector<double>& values) const {
    values.clear();
    for (std::size_t c = 0; c < std::min(cells.size(), columns_.size()); ++c) {
      // A comma may be meant as a decimal one: the cells' own mistakes come first.
      const auto value = parse_real(cells[c]);
      if (!value)
        refuse(fmt::format("{}: {} {}{}", column_text(c), quoted(cells[c]), why_no_number(cells[c]),
                           hint_on_names(cells)));
      values.push_back(*value);
    }
    if (cells.size() > columns_.size() && cells.back().empty())
      refuse(fmt::format("{} ends with a separator, behind which column {} is empty; take it away: each line is {}",
                         quoted(line), cells.size(), wanted_));
    if (cells.size() != columns_.size())
      refuse(fmt::format("has {}, must have {}: {}{}",
                         cells.size() == 1 ? "one value" : fmt::format("{} values", cells.size()),
                         count_text(columns_.size()), wanted_,
                         cells.size() > columns_.size() && separator == ','
                             ? " (numbers have decimal points; a comma separates columns)"
                             : ""));
    if (separator != separator_)
      refuse(fmt::format("its columns are separated by {}, those of line {} by {}; take the same in all lines",
                         name_of(separator), first_line_, name_of(separator_)));
  }

  /// Names with a number among them are taken for numbers.
  std::string hint_on_names(const Cells& cells) const {
    const bool mixed = line_ == first_line_ && !looks_like_number(cells.front());
    return mixed ? " (a line of names has nothing that begins like a number; write # before remarks)" : "";
  }

  void take_needed_names(std::string_view line, const Cells& cells) {
    bool same = cells.size() == columns_.size();
    for (std::size_t c = 0; same && c < cells.size(); ++c) {
      const auto words = words_of(cells[c]);
      same = !words.empty() && lower(words[0]) == columns_[c].name;
    }
    if (!same)
      refuse(fmt::format("the {}line is {}, must name the columns: {}", line_ == 1 ? "first " : "", quoted(line),
                         wanted_));
    check_names(cells);
    named_ = true;
  }

  void check_names(const Cells& cells) const {
    if (cells.size() != columns_.size()) return;  // a title, say
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto words = words_of(cells[c]);
      for (const std::string& word : words)
        if (const auto& others = columns_[c].other_units; std::find(others.begin(), others.end(), word) != others.end())
          refuse(fmt::format("{} is called {}, but is read in {}; convert the numbers, and the name", column_text(c),
                             quoted(cells[c]), columns_[c].unit));
      const auto is = [&](std::size_t other) { return !words.empty() && lower(words[0]) == columns_[other].name; };
      for (std::size_t other = 0; other < columns_.size(); ++other)
        if (other != c && is(other) && !is(c))
          refuse(fmt::format("{} is called {}; the order of the columns must be {}", column_text(c), quoted(cells[c]),
                             wanted_));
    }
  }

  const std::string& path_;
  const std::vector<TableColumn>& columns_;
  TableNames names_;
  std::string wanted_;             ///< "time,value"
  int line_ = 1, first_line_ = 0;  ///< of numbers; 0: there was none yet
  char separator_ = '\0';
  bool named_ = false;
};

void refuse_encoding(std::string_view text, const TableReader& reader) {
  const auto begins = [&](std::string_view mark) { return text.substr(0, mark.size()) == mark; };
  if (begins("\xff\xfe") || begins("\xfe\xff") || text.substr(0, 4).find('\0') != std::string_view::npos)
    reader.refuse(
        "the file is UTF-16 or UTF-32 text, or none; save it as UTF-8 (in a spreadsheet: CSV, encoding UTF-8)");
}

}  // namespace

TableColumn time_column(const std::string& name) {
  return {name,
          "s",
          {"ms", "msec", "millisec", "milliseconds", "us", "usec", "\xc2\xb5s", "\xce\xbcs", "microseconds", "ns",
           "min", "minutes", "h", "hours"}};
}

TableColumn length_column(const std::string& name) {
  return {name,
          "m",
          {"mm", "millimetres", "millimeters", "cm", "um", "\xc2\xb5m", "\xce\xbcm", "micrometres", "micrometers", "nm",
           "km", "inch", "ft"}};
}

void parse_number_table(std::string_view text, const std::string& path, const std::vector<TableColumn>& columns,
                        TableNames names,
                        const std::function<void(int line, const std::vector<double>& values)>& take) {
  TableReader reader(path, columns, names);
  refuse_encoding(text, reader);
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
  std::vector<double> values;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find_first_of("\r\n", begin), text.size());
    if (reader.read(++number, text.substr(begin, end - begin), values)) take(number, values);
    begin = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  }
}

}  // namespace railwave
