#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <set>

#include "case/keys.hpp"
#include "case/read_value.hpp"
#include "case/reference.hpp"
#include "source_folder.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using namespace railwave::case_file;

namespace {
const std::filesystem::path docs = std::filesystem::path(source_folder) / "docs";
}

TEST_CASE("docs/case-file.md is what the table of keys says", "[case]") {
  INFO("make it anew: railwave reference --markdown > docs/case-file.md");
  CHECK((text_of(docs / "case-file.md") == case_reference_markdown()));
}

TEST_CASE("docs/case.schema.json is what the table of keys says", "[case]") {
  INFO("make it anew: railwave reference --schema > docs/case.schema.json");
  CHECK((text_of(docs / "case.schema.json") == case_schema_json()));
}

TEST_CASE("the page's example is a case", "[case]") {
  const auto page = case_reference_markdown();
  const std::string fence = "```toml\n";
  const auto begin = page.find(fence) + fence.size();
  TemporaryCase file(page.substr(begin, page.find("```", begin) - begin));
  CHECK(mistakes_of(file.path()).empty());
}

TEST_CASE("each type of mesh has keys of its own, and the table of sets names types that there are", "[case]") {
  const auto* section = find_section("meshes");
  REQUIRE(section);
  const auto& types = section->type_key()->choices;
  CHECK(types.size() == std::size(scene::mesh_type_names));
  for (const auto& type : types) {
    INFO("type " << type);
    CHECK(std::any_of(section->keys.begin(), section->keys.end(),
                      [&](const Key& key) { return !key.types.empty() && key.belongs_to(type); }));
  }
  for (const auto& row : mesh_sets()) {
    INFO("type " << row.type);
    CHECK(std::find(types.begin(), types.end(), row.type) != types.end());
  }
}

TEST_CASE("the table of keys is sound", "[case]") {
  std::set<std::string> names;
  for (const auto& section : sections()) {
    INFO("section [" << section.name << "]");
    CHECK(names.insert(section.name).second);
    CHECK_FALSE(section.help.empty());
    CHECK_FALSE(section.keys.empty());
    CHECK(section.open);
    std::set<std::string> seen;
    for (const auto& key : section.keys) {
      INFO("key " << key.name);
      CHECK_FALSE(key.help.empty());
      CHECK(key.kind != Kind::absent);
      CHECK((key.kind != Kind::choice || !key.choices.empty()));
      CHECK((key.required || key.kind == Kind::texts || key.name == "title" || !default_text(key).empty()));
      for (const auto& type : key.types) {
        const auto& types = section.type_key()->choices;
        CHECK(std::find(types.begin(), types.end(), type) != types.end());
        CHECK(seen.insert(key.name + " of " + type).second);
      }
      if (key.types.empty()) CHECK(seen.insert(key.name).second);
    }
  }
}

TEST_CASE("defaults are within their own range", "[case]") {
  for (const auto& section : sections()) {
    for (const auto& key : section.keys) {
      if (key.required || key.kind != Kind::number || !key.default_text.empty()) continue;
      INFO("[" << section.name << "] " << key.name);
      const Value initial = key.initial();  // absent where leaving the key out means something else
      if (const double* number = std::get_if<double>(&initial)) CHECK(key.range.has(*number));
    }
  }
}

TEST_CASE("help tells a section, a key, or a key of one section", "[case]") {
  CHECK(case_help("").find("[parts.NAME]") != std::string::npos);
  const auto part = case_help("parts");
  CHECK(part.find("hourglass_coefficient") != std::string::npos);
  CHECK(part.find("(required)") != std::string::npos);
  const auto key = case_help("poissons_ratio");
  CHECK(key.find("[materials.NAME]") != std::string::npos);
  CHECK(key.find("between -0.999 and 0.4999") != std::string::npos);
  CHECK(case_help("time.end").find("meshes") == std::string::npos);
  CHECK(case_help("end").find("meshes") != std::string::npos);
  CHECK(case_help("watch") == case_help("monitor"));
}

TEST_CASE("help for an unknown topic names the nearest", "[case]") {
  const auto said = [](const std::string& topic) {
    try {
      return case_help(topic);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  CHECK(said("hourglas") == "no section or key of the case file is called 'hourglas'; did you mean 'hourglass'?");
  CHECK(said("part.mesh").find("no section or key") == 0);
  CHECK(said("xyzzy").find("sections are: materials, meshes") != std::string::npos);
}
