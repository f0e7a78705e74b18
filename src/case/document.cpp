#include "case/document.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

// toml++ 3.3 asserts what a wrong text such as "[ ]" or "a = [}" breaks: make that an error like any other, in every
// kind of build.
namespace railwave::case_file {
struct BrokenAssumption {};
}  // namespace railwave::case_file
#undef NDEBUG
#define TOML_ASSERT(expression) ((expression) ? static_cast<void>(0) : throw railwave::case_file::BrokenAssumption{})
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wterminate"
#include <toml++/toml.h>
#pragma GCC diagnostic pop

namespace railwave::case_file {
namespace {

Node converted(const toml::node& source);

struct Child {
  toml::source_position position;
  Node node;
};

void convert_table(const toml::table& table, Node& node) {
  std::vector<Child> found;
  for (const auto& [key, value] : table) {
    Child child{key.source().begin, converted(value)};
    child.node.name = std::string(key.str());
    child.node.where.line = static_cast<int>(key.source().begin.line);
    found.push_back(std::move(child));
  }
  // toml++ sorts by name; people read and count in the file's order.
  std::stable_sort(found.begin(), found.end(), [](const Child& a, const Child& b) { return a.position < b.position; });
  for (auto& child : found) node.children.push_back(std::move(child.node));
}

Node converted(const toml::node& source) {
  Node node;
  node.where.line = static_cast<int>(source.source().begin.line);
  if (const auto* table = source.as_table()) {
    node.type = Node::Type::table;
    convert_table(*table, node);
  } else if (const auto* list = source.as_array()) {
    node.type = Node::Type::list;
    for (const auto& item : *list) node.children.push_back(converted(item));
  } else if (const auto* text = source.as_string()) {
    node.type = Node::Type::text;
    node.text = text->get();
  } else if (const auto* integer = source.as_integer()) {
    node.type = Node::Type::integer;
    node.integer = integer->get();
    node.number = static_cast<double>(node.integer);
  } else if (const auto* number = source.as_floating_point()) {
    node.type = Node::Type::number;
    node.number = number->get();
  } else if (const auto* boolean = source.as_boolean()) {
    node.type = Node::Type::boolean;
    node.boolean = boolean->get();
  } else {
    node.type = Node::Type::date;
  }
  return node;
}

struct SyntaxError {
  int line = 0;
  std::string text;
};

/// Position and length of a line (from 1) in the text, without its end.
std::pair<std::size_t, std::size_t> line_extent(const std::string& text, int line) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) {
    const auto end = text.find('\n', begin);
    if (end == std::string::npos) return {text.size(), 0};
    begin = end + 1;
  }
  return {begin, std::min(text.find('\n', begin), text.size()) - begin};
}

bool breaks_assumption(const std::string& text) {
  try {
    static_cast<void>(toml::parse(text));
  } catch (const BrokenAssumption&) {
    return true;
  } catch (const toml::parse_error&) {
  }
  return false;
}

/// The first line after which the text cannot be parsed any more.
int line_that_breaks(const std::string& text) {
  int good = 0, bad = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  while (bad - good > 1) {
    const int middle = good + (bad - good) / 2;
    const auto [begin, length] = line_extent(text, middle);
    (breaks_assumption(text.substr(0, std::min(begin + length + 1, text.size()))) ? bad : good) = middle;
  }
  return bad;
}

/// First line with a name of very many parts ("a.a.a..."), which would be nested tables without end; 0 without one.
int line_of_endless_name(const std::string& text) {
  constexpr int most_dots = 200;
  int line = 1, dots = 0;
  char last = '\n';
  bool comment = false;
  for (const char letter : text) {
    const bool in_name =
        std::isalnum(static_cast<unsigned char>(letter)) || std::string("_-.\"' \t").find(letter) != std::string::npos;
    if (!in_name) dots = 0;
    if (letter == '.' && last != '.' && !comment && ++dots > most_dots) return line;
    if (letter == '#') comment = true;
    if (letter == '\n') {
      comment = false;
      ++line;
    }
    if (letter != ' ' && letter != '\t') last = letter;
  }
  return 0;
}

std::optional<SyntaxError> try_parse(const std::string& text, toml::table& table) {
  if (const int line = line_of_endless_name(text); line > 0) return SyntaxError{line, "a name has more than 200 dots"};
  try {
    table = toml::parse(text);
    return std::nullopt;
  } catch (const toml::parse_error& error) {
    return SyntaxError{static_cast<int>(error.source().begin.line), std::string(error.description())};
  } catch (const BrokenAssumption&) {
    return SyntaxError{line_that_breaks(text), "a name or a value is missing, or a bracket is misplaced"};
  }
}

/// Line of the last '[' before `line` that opens a value and is not closed; 0 without one.
int open_bracket(const std::string& text, int line) {
  for (int at = line; at > 0; --at) {
    const auto [begin, length] = line_extent(text, at);
    const auto one = text.substr(begin, length);
    const auto equals = one.find('=');
    if (equals == std::string::npos || one.find('[', equals) == std::string::npos) continue;
    return std::count(one.begin(), one.end(), '[') > std::count(one.begin(), one.end(), ']') ? at : 0;
  }
  return 0;
}

/// What to write instead, for the slips that people make.
std::string hint(const std::string& line, const std::string& error, int open_at) {
  const auto equals = line.find('=');
  std::string value = equals == std::string::npos ? "" : line.substr(equals + 1);
  value.erase(0, value.find_first_not_of(" \t"));
  const auto has = [&](const char* piece) { return error.find(piece) != std::string::npos; };
  if (has("expected a comment or whitespace, saw ','"))
    return "decimals have a point, and lists stand in brackets: [x, y, z]";
  if (has("expected a comment or whitespace") && !value.empty() && std::isdigit(static_cast<unsigned char>(value[0]))) {
    return "a value is one plain number in SI units, without its unit; each key has its own line";
  }
  if (has("expected value, saw")) return "the value after '=' is missing";
  if (has("could not determine value type")) return "text stands in quotes";
  if (has("expected 'true'") || has("expected 'false'"))
    return "text stands in quotes; true and false are written small";
  if (has("parsing array") && open_at > 0)
    return "the '[' of line " + std::to_string(open_at) + " may not be closed, or a comma may be missing";
  if (has("parsing array")) return "a '[' may not be closed, or a comma may be missing";
  if (has("control characters")) return "the text's closing quote is missing";
  if (has("string: encountered end-of-file")) return "a text's closing quotes are missing, perhaps far above";
  if (has("blank bare keys")) return "a section has a name: [time] or [parts.NAME]";
  if (has("table header") && has("expected ']'")) return "a section is written [name] or [name.NAME]";
  if (has("leading zeroes")) return "write it without the zeroes in front";
  if (has("floating-point: expected decimal digit")) return "write 0.5 or 1.0, not .5 or 1.";
  return "";
}

std::string friendly(const std::string& error) {
  std::string text = error;
  const std::string prefix = "Error while parsing ";
  if (text.rfind(prefix, 0) == 0) {
    const char first = text[prefix.size()];
    text = (first == 'a' || first == 'i' ? "in an " : "in a ") + text.substr(prefix.size());
  }
  const std::string line_end = "'\\n'";
  if (const auto at = text.find(line_end); at != std::string::npos)
    text.replace(at, line_end.size(), "the end of the line");
  if (const auto at = text.find("unescaped control characters"); at != std::string::npos)
    text = text.substr(0, at) + "the line ends inside it";
  if (const auto at = text.find("control characters other"); at != std::string::npos)
    text = text.substr(0, at) + "the line ends inside it";
  const std::string repeated = "cannot redefine existing ";
  if (const auto at = text.find(repeated); at != std::string::npos) {
    const auto quote = text.find('\'', at);
    return quote == std::string::npos ? text : text.substr(quote) + " is defined a second time; keep one of them";
  }
  return "not valid TOML: " + text;
}

/// True when leaving the line out mends the text: it is a key with a value all on one line, and wrong for itself or a
/// repetition.
bool line_is_to_blame(const std::string& line, const SyntaxError& error) {
  const auto first = line.find_first_not_of(" \t");
  if (first == std::string::npos || line[first] == '[' || line.find('=') == std::string::npos) return false;
  if (line.find("\"\"\"") != std::string::npos || line.find("'''") != std::string::npos) return false;
  if (std::count(line.begin(), line.end(), '[') != std::count(line.begin(), line.end(), ']')) return false;
  toml::table alone;
  return error.text.find("cannot redefine") != std::string::npos || try_parse(line, alone).has_value();
}

}  // namespace

const Node* Node::find(const std::string& child) const {
  for (const auto& one : children) {
    if (one.name == child) return &one;
  }
  return nullptr;
}

Node* Node::find(const std::string& child) { return const_cast<Node*>(static_cast<const Node&>(*this).find(child)); }

std::string Node::described() const {
  switch (type) {
    case Type::text:
      return "text";
    case Type::integer:
    case Type::number:
      return "a number";
    case Type::boolean:
      return "true or false";
    case Type::date:
      return "a date or time";
    case Type::list:
      return "a list";
    case Type::table:
      return "a table";
  }
  return "";
}

Document parse_document(std::string text, Complaints& complaints) {
  constexpr int most_errors = 20;
  Document document;
  toml::table table;
  for (int errors = 0; errors < most_errors; ++errors) {
    const auto error = try_parse(text, table);
    if (!error) {
      convert_table(table, document.root);
      document.usable = true;
      document.complete = errors == 0;
      return document;
    }
    const auto [begin, length] = line_extent(text, error->line);
    const auto line = text.substr(begin, length);
    const auto advice = hint(line, error->text, open_bracket(text, error->line));
    complaints.add({error->line}, printable(friendly(error->text), 300) + (advice.empty() ? "" : " (" + advice + ")"));
    if (!line_is_to_blame(line, *error)) return document;
    text.replace(begin, length, "");
  }
  return document;
}

bool parse_override_value(const std::string& text, const std::string& whole, Node& value, Complaints& complaints) {
  toml::table table;
  const auto error = try_parse("value = " + text, table);
  if (!error && table.size() == 1 && table.contains("value")) {
    value = converted(*table.get("value"));
  } else {
    const auto first = text.find_first_not_of(" \t");
    const bool meant_as_toml =
        first != std::string::npos && std::string("[{\"'").find(text[first]) != std::string::npos;
    if (meant_as_toml || first == std::string::npos || text.find('\n') != std::string::npos) {
      complaints.add({0, true},
                     printable(whole) + ": " +
                         (first == std::string::npos
                              ? "the value after '=' is missing"
                              : "the value is not valid TOML; lists stand in brackets, [x, y, z], and text in quotes"));
      return false;
    }
    value = Node{};
    value.type = Node::Type::text;
    value.text = text;
  }
  const auto mark = [](auto&& self, Node& node) -> void {
    node.where = {0, true};
    for (auto& child : node.children) self(self, child);
  };
  mark(mark, value);
  return true;
}

}  // namespace railwave::case_file
