#include <cmath>

#include "case/json.hpp"
#include "case/keys.hpp"
#include "case/plausible.hpp"
#include "case/read_value.hpp"
#include "case/reference.hpp"
#include "case/references.hpp"

namespace railwave {
namespace {

using namespace case_file;
using json::Members;

void add_range(Members& schema, const Range& range) {
  if (std::isfinite(range.low))
    schema.emplace_back(range.low_open ? "exclusiveMinimum" : "minimum", json::number(range.low));
  if (std::isfinite(range.high))
    schema.emplace_back(range.high_open ? "exclusiveMaximum" : "maximum", json::number(range.high));
}

Members ranged(const char* type, const Range& range) {
  Members schema{{"type", json::text(type)}};
  add_range(schema, range);
  return schema;
}

Members list_of(const Members& items, const std::string& least, const std::string& most) {
  Members schema{{"type", json::text("array")}, {"items", json::object(items)}};
  if (!least.empty()) schema.emplace_back("minItems", least);
  if (!most.empty()) schema.emplace_back("maxItems", most);
  return schema;
}

Members text_schema(const Key& key) {
  Members schema{{"type", json::text("string")}};
  if (!key.choices.empty()) schema.emplace_back("enum", json::texts(key.choices));
  return schema;
}

Members pair_schema(const Key& key) {
  return {{"type", json::text("array")},
          {"prefixItems", json::list({json::object(ranged("number", key.pair.first_range)),
                                      json::object(ranged("number", key.pair.second_range))})},
          {"minItems", "2"},
          {"maxItems", "2"}};
}

Members value_schema(const Key& key) {
  const auto least = key.required ? "1" : "";
  const auto numbers = list_of(ranged("number", allowed_range(key)), "3", "3");
  switch (key.kind) {
    case Kind::absent:
      return {};
    case Kind::boolean:
      return {{"type", json::text("boolean")}};
    case Kind::integer:
      return ranged("integer", allowed_range(key));
    case Kind::number:
      return ranged("number", allowed_range(key));
    case Kind::text:
    case Kind::choice:
      return text_schema(key);
    case Kind::vector:
      return numbers;
    case Kind::integer_vector:
      return list_of(ranged("integer", allowed_range(key)), "3", "3");
    case Kind::axes:
      return list_of(numbers, "3", "3");
    case Kind::directions:
      return list_of({{"enum", json::texts({"x", "y", "z"})}}, "1", "3");
    case Kind::texts:
      if (!key.may_be_one) return list_of(text_schema(key), least, "");
      return {
          {"anyOf", json::list({json::object(text_schema(key)), json::object(list_of(text_schema(key), least, ""))})}};
    case Kind::pairs:
      return list_of(pair_schema(key), "1", "");
    case Kind::numbers:
      return list_of(ranged("number", allowed_range(key)), "1", "");
    case Kind::integer_pair:
      return list_of(ranged("integer", allowed_range(key)), "2", "2");
    case Kind::box:
      return list_of(numbers, "2", "2");
  }
  return {};
}

/// One line for the editor's tooltip: meaning, what it refers to, unit, default.
std::string description(const Key& key) {
  auto text = key.help;
  if (key.refers_to != refers_to_nothing) text += " (" + reference_text(key.refers_to) + ")";
  if (!key.unit.empty()) text += ", in " + key.unit;
  const auto standard = default_text(key);
  if (key.required)
    text += "; required";
  else if (!standard.empty())
    text += "; default " + standard;
  return text;
}

std::string key_schema(const Key& key) {
  auto schema = value_schema(key);
  schema.emplace_back("description", json::text(description(key)));
  return json::object(schema);
}

/// The table of one entry; `type` "" when all entries of the section have the same keys.
std::string entry_schema(const Section& section, const std::string& type) {
  Members properties;
  std::vector<std::string> required;
  for (const auto& key : section.keys) {
    if (!key.belongs_to(type)) continue;
    const bool fixes_type = !type.empty() && key.name == "type";
    properties.emplace_back(key.name, fixes_type ? json::object({{"const", json::text(type)},
                                                                 {"description", json::text(description(key))}})
                                                 : key_schema(key));
    if (key.required) required.push_back(key.name);
  }
  Members schema{{"type", json::text("object")}, {"properties", json::object(properties)}};
  if (!required.empty()) schema.emplace_back("required", json::texts(required));
  schema.emplace_back("additionalProperties", "false");
  return json::object(schema);
}

std::string any_entry_schema(const Section& section) {
  const auto* type = section.type_key();
  if (!type) return entry_schema(section, "");
  std::vector<std::string> alternatives;
  for (const auto& one : type->choices) alternatives.push_back(entry_schema(section, one));
  return json::object(
      {{"type", json::text("object")}, {"required", json::texts({"type"})}, {"oneOf", json::list(alternatives)}});
}

std::string section_schema(const Section& section) {
  if (!section.named()) return entry_schema(section, "");
  Members schema{{"type", json::text("object")},
                 {"description", json::text(section.help)},
                 {"propertyNames", json::object({{"pattern", json::text("^[A-Za-z0-9_-]+$")}})},
                 {"additionalProperties", any_entry_schema(section)}};
  if (section.required && section.name != "parts") schema.emplace_back("minProperties", "1");
  return json::object(schema);
}

}  // namespace

std::string case_schema_json() {
  Members properties;
  std::vector<std::string> required;
  for (const auto& section : sections()) {
    if (section.name.empty()) {
      for (const auto& key : section.keys) properties.emplace_back(key.name, key_schema(key));
    } else {
      properties.emplace_back(section.name, section_schema(section));
    }
    if (section.required && section.name != "parts") required.push_back(section.name);
  }
  // Tracks make parts of their own.
  const auto one_needed = [](const char* name) { return json::object({{"required", json::texts({name})}}); };
  return json::indented(json::object({{"$schema", json::text("https://json-schema.org/draft/2020-12/schema")},
                                      {"title", json::text("Railwave case file")},
                                      {"type", json::text("object")},
                                      {"properties", json::object(properties)},
                                      {"required", json::texts(required)},
                                      {"anyOf", json::list({one_needed("parts"), one_needed("tracks")})},
                                      {"additionalProperties", "false"}}));
}

}  // namespace railwave
