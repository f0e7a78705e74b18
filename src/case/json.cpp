#include "case/json.hpp"

#include <fmt/format.h>

namespace railwave::case_file::json {
namespace {

std::string surrounded(char open, const std::vector<std::string>& items, char close) {
  std::string result(1, open);
  for (std::size_t i = 0; i < items.size(); ++i) result += (i == 0 ? "" : ",") + items[i];
  return result + close;
}

std::size_t end_of_text(const std::string& json, std::size_t begin) {
  std::size_t at = begin + 1;
  while (json[at] != '"') at += json[at] == '\\' ? 2 : 1;
  return at;
}

/// Position of the bracket that closes a list without objects or lists in it, or npos.
std::size_t end_of_plain_list(const std::string& json, std::size_t begin) {
  for (std::size_t at = begin + 1; at < json.size(); ++at) {
    if (json[at] == '"')
      at = end_of_text(json, at);
    else if (json[at] == ']')
      return at;
    else if (json[at] == '[' || json[at] == '{')
      return std::string::npos;
  }
  return std::string::npos;
}

}  // namespace

std::string text(const std::string& plain) {
  std::string result = "\"";
  for (const char letter : plain) {
    if (letter == '"' || letter == '\\') result += '\\';
    result += letter;
  }
  return result + "\"";
}

std::string number(double value) { return fmt::format("{}", value); }

std::string list(const std::vector<std::string>& items) { return surrounded('[', items, ']'); }

std::string texts(const std::vector<std::string>& plain) {
  std::vector<std::string> items;
  for (const auto& one : plain) items.push_back(text(one));
  return list(items);
}

std::string object(const Members& members) {
  std::vector<std::string> items;
  for (const auto& [name, value] : members) items.push_back(text(name) + ":" + value);
  return surrounded('{', items, '}');
}

std::string indented(const std::string& compact) {
  std::string result;
  std::size_t depth = 0;
  const auto new_line = [&] { result += "\n" + std::string(2 * depth, ' '); };
  for (std::size_t at = 0; at < compact.size(); ++at) {
    const char letter = compact[at];
    if (letter == '"') {
      const auto end = end_of_text(compact, at);
      result.append(compact, at, end - at + 1);
      at = end;
    } else if (letter == '[' && end_of_plain_list(compact, at) != std::string::npos) {
      const auto end = end_of_plain_list(compact, at);
      for (; at <= end; ++at) {
        const bool quoted = compact[at] == '"';
        const auto stop = quoted ? end_of_text(compact, at) : at;
        result.append(compact, at, stop - at + 1);
        if (!quoted && compact[at] == ',') result += ' ';
        at = stop;
      }
      at = end;
    } else if (letter == '{' || letter == '[') {
      result += letter;
      const bool empty = compact[at + 1] == '}' || compact[at + 1] == ']';
      if (empty) {
        result += compact[++at];
      } else {
        ++depth;
        new_line();
      }
    } else if (letter == '}' || letter == ']') {
      --depth;
      new_line();
      result += letter;
    } else if (letter == ',') {
      result += letter;
      new_line();
    } else {
      result += letter;
      if (letter == ':') result += ' ';
    }
  }
  return result + "\n";
}

}  // namespace railwave::case_file::json
