#include <cmath>
#include <nlohmann/json.hpp>

#include "case/keys.hpp"
#include "case/plausible.hpp"
#include "case/read_value.hpp"
#include "case/reference.hpp"
#include "case/references.hpp"

namespace railwave {
namespace {

using namespace case_file;
using Json = nlohmann::ordered_json;  // members as they are added: the table's order

/// Whole numbers without a decimal point.
Json number(double value) {
  constexpr double exact = 9007199254740992;  // 2^53
  if (std::floor(value) == value && std::fabs(value) <= exact) return static_cast<long long>(value);
  return value;
}

Json ranged(const char* type, const Range& range) {
  Json schema{{"type", type}};
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = number(range.low);
  if (std::isfinite(range.high)) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = number(range.high);
  return schema;
}

/// @param least, most entries; 0: any number
Json list_of(const Json& items, int least, int most) {
  Json schema{{"type", "array"}, {"items", items}};
  if (least > 0) schema["minItems"] = least;
  if (most > 0) schema["maxItems"] = most;
  return schema;
}

Json text_schema(const Key& key) {
  Json schema{{"type", "string"}};
  if (!key.choices.empty()) schema["enum"] = key.choices;
  return schema;
}

Json pair_schema(const Key& key) {
  Json schema{{"type", "array"}};
  schema["prefixItems"] =
      Json::array({ranged("number", key.pair.first_range), ranged("number", key.pair.second_range)});
  schema["minItems"] = 2;
  schema["maxItems"] = 2;
  return schema;
}

Json value_schema(const Key& key) {
  const int least = key.required ? 1 : 0;
  const Json numbers = list_of(ranged("number", allowed_range(key)), 3, 3);
  switch (key.kind) {
    case Kind::absent:
      return Json::object();
    case Kind::boolean:
      return {{"type", "boolean"}};
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
      return list_of(ranged("integer", allowed_range(key)), 3, 3);
    case Kind::axes:
      return list_of(numbers, 3, 3);
    case Kind::directions:
      return list_of({{"enum", Json::array({"x", "y", "z"})}}, 1, 3);
    case Kind::texts:
      if (!key.may_be_one) return list_of(text_schema(key), least, 0);
      return {{"anyOf", Json::array({text_schema(key), list_of(text_schema(key), least, 0)})}};
    case Kind::pairs:
      return list_of(pair_schema(key), 1, 0);
    case Kind::numbers:
      return list_of(ranged("number", allowed_range(key)), 1, 0);
    case Kind::integer_pair:
      return list_of(ranged("integer", allowed_range(key)), 2, 2);
    case Kind::box:
      return list_of(numbers, 2, 2);
  }
  return Json::object();
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

Json key_schema(const Key& key) {
  Json schema = value_schema(key);
  schema["description"] = description(key);
  return schema;
}

/// The table of one entry; `type` "" when all entries of the section have the same keys.
Json entry_schema(const Section& section, const std::string& type) {
  Json properties = Json::object(), required = Json::array();
  for (const auto& key : section.keys) {
    if (!key.belongs_to(type)) continue;
    const bool fixes_type = !type.empty() && key.name == "type";
    properties[key.name] = fixes_type ? Json{{"const", type}, {"description", description(key)}} : key_schema(key);
    if (key.required) required.push_back(key.name);
  }
  Json schema{{"type", "object"}, {"properties", properties}};
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  return schema;
}

Json any_entry_schema(const Section& section) {
  const auto* type = section.type_key();
  if (!type) return entry_schema(section, "");
  Json alternatives = Json::array();
  for (const auto& one : type->choices) alternatives.push_back(entry_schema(section, one));
  return {{"type", "object"}, {"required", Json::array({"type"})}, {"oneOf", alternatives}};
}

Json section_schema(const Section& section) {
  if (!section.named()) return entry_schema(section, "");
  Json schema{{"type", "object"},
              {"description", section.help},
              {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]+$"}}},
              {"additionalProperties", any_entry_schema(section)}};
  if (section.required && section.name != "parts") schema["minProperties"] = 1;
  return schema;
}

}  // namespace

std::string case_schema_json() {
  Json properties = Json::object(), required = Json::array();
  for (const auto& section : sections()) {
    if (section.name.empty()) {
      for (const auto& key : section.keys) properties[key.name] = key_schema(key);
    } else {
      properties[section.name] = section_schema(section);
    }
    if (section.required && section.name != "parts") required.push_back(section.name);
  }
  // Tracks make parts of their own.
  const auto one_needed = [](const char* name) { return Json{{"required", Json::array({name})}}; };
  const Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                    {"title", "Railwave case file"},
                    {"type", "object"},
                    {"properties", properties},
                    {"required", required},
                    {"anyOf", Json::array({one_needed("parts"), one_needed("tracks")})},
                    {"additionalProperties", false}};
  return schema.dump(2) + '\n';
}

}  // namespace railwave
