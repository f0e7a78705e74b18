#include "mesh/files/abaqus_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

std::string upper_case_without_blanks(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (c == ' ' || c == '\t') continue;
    result += (c >= 'a' && c <= 'z') ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return result;
}

std::string without_quotes(std::string_view text) {
  if (text.size() >= 2 && text.front() == text.back() && (text.front() == '"' || text.front() == '\''))
    text = text.substr(1, text.size() - 2);
  return std::string(trim(text));
}

// Splits at commas outside double quotes.
std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  bool quoted = false;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i == line.size() || (line[i] == ',' && !quoted)) {
      fields.push_back(trim(line.substr(start, i - start)));
      start = i + 1;
    }
  }
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

}  // namespace

std::string AbaqusKeyword::value(const std::string& key) const {
  const auto entry = parameters.find(key);
  return entry == parameters.end() ? "" : lower_case(entry->second);
}

AbaqusLines::AbaqusLines(const std::string& path, std::vector<std::string>& files) : files_(files) {
  open(path, nullptr);
}

void AbaqusLines::open(const std::string& path, const FilePlace* from) {
  auto source = std::make_unique<Source>();
  source->text = files_.open(path, from);
  source->file = files_.last();
  sources_.push_back(std::move(source));
}

bool AbaqusLines::fill() {
  // An include stands for the lines of its file, wherever it is, also between data lines.
  while (fill_plain()) {
    if (current_[0] != '*' || upper_case_without_blanks(current_.substr(0, current_.find(','))) != "*INCLUDE")
      return true;
    include(read_keyword());
  }
  return false;
}

bool AbaqusLines::fill_plain() {
  while (!filled_ && !sources_.empty()) {
    Source& source = *sources_.back();
    if (source.offset >= source.text.size()) {
      sources_.pop_back();
      continue;
    }
    const std::string_view rest = std::string_view(source.text).substr(source.offset);
    const auto length = std::min(rest.find('\n'), rest.size());
    source.offset += length + 1;
    current_place_ = {source.file, ++source.line};
    files_.check_text(rest.substr(0, length), current_place_, "an Abaqus or CalculiX input file");
    current_ = trim(rest.substr(0, length));
    filled_ = !current_.empty() && current_.substr(0, 2) != "**";
  }
  return filled_;
}

AbaqusKeyword AbaqusLines::take_keyword() {
  fill();
  return read_keyword();
}

AbaqusKeyword AbaqusLines::read_keyword() {
  AbaqusKeyword keyword;
  keyword.place = place_ = current_place_;
  std::string line(current_.substr(1));
  drop_line();
  // A comma at the end says that the next line belongs to this one. Numbers can't be parameters: there the comma is
  // idle.
  while (!line.empty() && line.back() == ',' && fill_plain() && current_[0] != '*') {
    const char first = current_[0];
    if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.') break;
    line += std::string(current_);
    place_ = current_place_;
    drop_line();
  }

  const auto fields = split(line);
  keyword.name = upper_case_without_blanks(fields[0]);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto equals = fields[i].find('=');
    const auto key = upper_case_without_blanks(fields[i].substr(0, equals));
    const auto value = equals == std::string_view::npos ? "" : without_quotes(trim(fields[i].substr(equals + 1)));
    if (!key.empty()) keyword.parameters[key] = value;
  }
  return keyword;
}

std::vector<std::string_view> AbaqusLines::take_fields() {
  fill();
  place_ = current_place_;
  drop_line();
  return split(current_);
}

void AbaqusLines::include(const AbaqusKeyword& keyword) {
  const auto input = keyword.parameters.find("INPUT");
  if (input == keyword.parameters.end() || input->second.empty())
    throw InputError(
        fmt::format("{} *{} names no file; write *{}, INPUT=file", where(keyword.place), keyword.name, keyword.name));
  const std::filesystem::path folder = std::filesystem::path(files_.path(keyword.place.file)).parent_path();
  open((folder / input->second).string(), &keyword.place);
}

}  // namespace railwave
