#pragma once

#include <string>

/// What the table of keys says, in three forms. docs/case-file.md and docs/case.schema.json are the first two as they
/// come.
namespace railwave {

/// The reference page of the case file, in Markdown.
std::string case_reference_markdown();

/// JSON Schema (draft 2020-12) of the case file, for editors that check TOML against one.
std::string case_schema_json();

/// Help for the terminal on a section ("parts"), a key ("hourglass"), one key of a section ("parts.hourglass"), or, for
/// "", the list of sections. Throws InputError with the nearest names when there is nothing of that name.
std::string case_help(const std::string& topic);

}  // namespace railwave
