#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace railwave {

/// What a column of a file of numbers is.
struct TableColumn {
  std::string name;  ///< as messages and a line of names have it
  std::string unit;  ///< "s", "m"; empty: none
  std::vector<std::string>
      other_units;  ///< that a line of names must not name, such as "ms": the numbers would be misread
};

/// Whether a file must name its columns.
enum class TableNames { may_stand, must_stand };

/// Reads a text of numbers in columns. All that is not wholly understood is refused, because a number misread is a
/// wrong run. Read are: UTF-8 with or without a byte-order mark; line ends \n, \r\n or \r; columns separated by commas,
/// semicolons, tabs or blanks, the same in all lines; decimal points; empty lines; remarks, lines that begin with # or
/// %; before the first number lines of names, in which nothing is or begins like a number. Refused are: decimal commas,
/// separated thousands, other numbers of columns, empty cells, quoted numbers, units behind numbers, hexadecimal,
/// infinite and not-a-number values, lines of text among the numbers, UTF-16, names in another unit or order.
/// @param text the file's bytes
/// @param path of the file, for messages
/// @param take called for each line of numbers with its number, from 1, and as many values as there are columns
/// @throws InputError "path:line: column 2 (value): '0,5' ...", with what is wanted
void parse_number_table(std::string_view text, const std::string& path, const std::vector<TableColumn>& columns,
                        TableNames names, const std::function<void(int line, const std::vector<double>& values)>& take);

/// Columns of time in s and of length in m, with the units that are mistaken for those.
TableColumn time_column(const std::string& name);
TableColumn length_column(const std::string& name);

}  // namespace railwave
