#include <cstddef>
#include <optional>

#include "case/document.hpp"
#include "case/keys.hpp"
#include "case/number_text.hpp"
#include "case/suggest.hpp"

namespace railwave::case_file {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1)
    words.push_back(path.substr(begin, dot - begin));
  words.push_back(path.substr(begin));
  return words;
}

std::vector<std::string> child_names(const Node& table) {
  std::vector<std::string> names;
  for (const auto& child : table.children) names.push_back(child.name);
  return names;
}

Node& find_or_add(Node& table, const std::string& name, Where where) {
  if (auto* found = table.find(name)) return *found;
  Node child;
  child.name = name;
  child.where = where;
  table.children.push_back(std::move(child));
  return table.children.back();
}

/// A key as it is written: a number behind it in brackets means one entry of its list.
struct Entry {
  std::string key;
  std::optional<std::size_t> index;
};

Entry entry_of(const std::string& word) {
  const auto open = word.find('[');
  if (open == std::string::npos || word.back() != ']') return {word, {}};
  const std::string digits = word.substr(open + 1, word.size() - open - 2);
  const auto number = parse_integer(digits);
  if (!number || *number < 0 || digits[0] == '+') return {word, {}};
  return {word.substr(0, open), static_cast<std::size_t>(*number)};
}

/// Puts a value into a list that the file has. @return what is wrong
std::string replace_entry(Node& table, const Entry& entry, const Node& value) {
  Node* list = table.find(entry.key);
  if (!list)
    return "the file does not say " + entry.key + ", so that it has no entry to replace; write " + entry.key +
           "=[...] with all of them";
  if (list->type != Node::Type::list) return entry.key + " is no list in the file; write " + entry.key + "=value";
  if (*entry.index >= list->children.size())
    return "the list in the file has " + std::to_string(list->children.size()) +
           " entries, which count from 0; there is no [" + std::to_string(*entry.index) + "]";
  Node& place = list->children[*entry.index];
  place = value;
  place.name.clear();
  list->where = value.where;
  return "";
}

/// The table that holds the key, or null with a complaint in `mistake`.
Node* holder(const std::vector<std::string>& words, Where where, Node& root, std::string& mistake) {
  if (words.size() == 1) {
    if (const auto* section = find_section(words[0]); section && !words[0].empty()) {
      mistake = "names a section; write " + words[0] + (section->named() ? ".NAME.key=value" : ".key=value");
      return nullptr;
    }
    return &root;
  }
  const auto* section = words[0].empty() ? nullptr : find_section(words[0]);
  if (!section) {
    const auto near = nearest_name(words[0], section_names());
    mistake = "there is no section [" + printable(words[0]) + "]; " +
              (near.empty() ? suggestion(words[0], section_names()) : "did you mean [" + near + "]?");
    return nullptr;
  }
  const std::size_t wanted = section->named() ? 3 : 2;
  if (words.size() != wanted) {
    mistake = std::string("must be ") + section->name + (section->named() ? ".NAME.key=value" : ".key=value");
    return nullptr;
  }
  if (!section->named()) {
    auto& table = find_or_add(root, section->name, where);
    return table.type == Node::Type::table ? &table : nullptr;
  }
  auto* entries = root.find(section->name);
  if (entries && entries->type != Node::Type::table) return nullptr;
  auto* entry = entries ? entries->find(words[1]) : nullptr;
  if (!entry) {
    const auto known = entries ? child_names(*entries) : std::vector<std::string>{};
    mistake = "the file has no " + section->singular + " '" + printable(words[1]) + "'" +
              (known.empty() ? "" : "; " + suggestion(words[1], known));
    return nullptr;
  }
  return entry->type == Node::Type::table ? entry : nullptr;
}

}  // namespace

void apply_overrides(const std::vector<std::string>& overrides, Node& root, Complaints& complaints,
                     Complaints& remarks) {
  Where where;
  for (const auto& text : overrides) {
    ++where.override_number;
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
      complaints.add(where, "'" + printable(text) + "' must be section.key=value, such as time.end=1e-3");
      continue;
    }
    const auto path = trimmed(text.substr(0, equals));
    auto words = split(path);
    if (const auto* section = find_renamed_section(words[0])) {
      remarks.add(where, renamed_text(*section));
      words[0] = section->name;
    }
    Node value;
    if (!parse_override_value(trimmed(text.substr(equals + 1)), path, where, value, complaints)) continue;
    std::string mistake;
    auto* table = holder(words, where, root, mistake);
    if (!mistake.empty()) complaints.add(where, printable(path) + ": " + mistake);
    if (!table) continue;
    if (const Entry entry = entry_of(words.back()); entry.index) {
      mistake = replace_entry(*table, entry, value);
      if (!mistake.empty()) complaints.add(where, printable(path) + ": " + mistake);
      continue;
    }
    value.name = words.back();
    auto& place = find_or_add(*table, value.name, where);
    place = value;
  }
}

}  // namespace railwave::case_file
