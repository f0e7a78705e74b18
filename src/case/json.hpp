#pragma once

#include <string>
#include <utility>
#include <vector>

/// JSON text from its pieces, in the order given.
namespace railwave::case_file::json {

using Members = std::vector<std::pair<std::string, std::string>>;  ///< name, JSON text of the value

std::string text(const std::string& plain);
std::string number(double value);
std::string list(const std::vector<std::string>& items);
std::string texts(const std::vector<std::string>& plain);
std::string object(const Members& members);

/// The same JSON with one member a line; lists of plain values stay on their line.
std::string indented(const std::string& compact);

}  // namespace railwave::case_file::json
