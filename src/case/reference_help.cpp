#include <fmt/format.h>

#include <algorithm>

#include "case/error.hpp"
#include "case/keys.hpp"
#include "case/read_value.hpp"
#include "case/reference.hpp"
#include "case/references.hpp"
#include "case/suggest.hpp"

namespace railwave {
namespace {

using namespace case_file;

std::string title(const Section& section) { return section.name.empty() ? "above all sections" : section.title(); }

std::string key_help(const Key& key) {
  std::string text = "  " + key.name;
  if (!key.types.empty()) text += fmt::format("  (type {})", joined(key.types));
  text += fmt::format("\n      {}\n      {}", key.help, expectation(key));
  if (key.refers_to != refers_to_nothing) text += ": " + reference_text(key.refers_to);
  const auto range = range_text(key.range);
  if (!range.empty()) text += ", " + range;
  const auto standard = default_text(key);
  text += key.required ? "; required" : standard.empty() ? "; optional" : "; default " + standard;
  return text + "\n";
}

std::string section_help(const Section& section) {
  const auto formerly = section.former_name.empty() ? "" : ", formerly [" + section.former_name + "]";
  auto text =
      fmt::format("{}{}{}\n  {}\n\n", title(section), formerly, section.required ? " (required)" : "", section.help);
  for (const auto& key : section.keys) text += key_help(key);
  return text;
}

std::string all_sections() {
  std::string text = "Sections of a case file:\n";
  for (const auto& section : sections()) {
    text += fmt::format("  {:24}{}\n", section.name.empty() ? "(above all sections)" : section.title(), section.help);
  }
  return text + "Ask for a section (parts), a key (hourglass) or both (parts.hourglass).\n";
}

/// With the section's present name in place of a former one.
std::string in_present_names(const std::string& topic) {
  const auto end = std::min(topic.find('.'), topic.size());
  const auto* section = find_renamed_section(topic.substr(0, end));
  return section ? section->name + topic.substr(end) : topic;
}

}  // namespace

std::string case_help(const std::string& topic) {
  if (topic.empty()) return all_sections();
  const auto name = in_present_names(topic);
  if (const auto* section = find_section(name)) return section_help(*section);
  const auto dot = name.find('.');
  const auto wanted_section = dot == std::string::npos ? "" : name.substr(0, dot);
  const auto wanted_key = dot == std::string::npos ? name : name.substr(name.rfind('.') + 1);
  std::string text;
  auto names = section_names();
  for (const auto& section : sections()) {
    if (dot != std::string::npos && section.name != wanted_section) continue;
    std::string found;
    for (const auto& key : section.keys) {
      names.push_back(key.name);
      if (key.name == wanted_key) found += key_help(key);
    }
    if (!found.empty()) text += (text.empty() ? "" : "\n") + title(section) + "\n" + found;
  }
  if (!text.empty()) return text;
  const auto near = nearest_name(wanted_key, names);
  throw InputError("no section or key of the case file is called '" + printable(topic) + "'; " +
                   (near.empty() ? "sections are: " + joined(section_names()) : "did you mean '" + near + "'?"));
}

}  // namespace railwave
