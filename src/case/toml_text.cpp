#include <fmt/format.h>

#include <cmath>

#include "case/document.hpp"

namespace railwave::case_file {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

std::string children_text(const Node& value) {
  std::string text;
  for (const Node& child : value.children) {
    const std::string name = value.type == Node::Type::table ? quoted(child.name) + " = " : "";
    text += (text.empty() ? "" : ", ") + name + toml_text(child);
  }
  return text;
}

}  // namespace

std::string toml_text(const Node& value) {
  switch (value.type) {
    case Node::Type::text:
      return quoted(value.text);
    case Node::Type::boolean:
      return value.boolean ? "true" : "false";
    case Node::Type::integer:
      return fmt::format("{}", value.integer);
    case Node::Type::number:
      if (std::isnan(value.number)) return "nan";
      return fmt::format("{}", value.number);
    case Node::Type::list:
      return '[' + children_text(value) + ']';
    case Node::Type::table:
      return '{' + children_text(value) + '}';
    case Node::Type::date:
      return value.text;
  }
  return "";
}

}  // namespace railwave::case_file
