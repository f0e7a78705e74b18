#include "mesh/files/abaqus_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

constexpr int deepest_include = 16;
constexpr int most_includes = 10000;

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

std::string AbaqusLines::where(const FilePlace& place) const {
  return fmt::format("{}:{}:", files_[place.file], place.position);
}

void AbaqusLines::open(const std::string& path, const FilePlace* from) {
  const auto here = from ? where(*from) + " " : std::string();
  std::error_code error;
  const auto real_path = std::filesystem::weakly_canonical(path, error).string();
  int depth = 0;
  // By who named whom: a file that includes another in its last line has been read to its end by now.
  for (int file = from ? from->file : -1; file >= 0; file = opened_[file].from, ++depth)
    if (opened_[file].real_path == real_path)
      throw InputError(
          fmt::format("{}includes {}, which is being read already; a file can't include itself", here, path));
  if (depth > deepest_include)
    throw InputError(fmt::format("{}includes {}: more than {} files inside one another; put them into fewer", here,
                                 path, deepest_include));
  if (++includes_ > most_includes)
    throw InputError(
        fmt::format("{}includes {}: more than {} inclusions; put them into fewer files", here, path, most_includes));
  auto source = std::make_unique<Source>();
  try {
    source->text = read_whole_file(path);
  } catch (const InputError& problem) {
    throw InputError(here + (from ? "includes " : "") + problem.what());
  }
  opened_.push_back({real_path, from ? from->file : -1});
  source->file = static_cast<int>(files_.size());
  if (source->text.compare(0, 3, "\xef\xbb\xbf") == 0) source->offset = 3;  // byte order mark of UTF-8
  files_.push_back(path);
  sources_.push_back(std::move(source));
}

void AbaqusLines::check_text(std::string_view line) const {
  for (char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 && c != '\t' && c != '\r' && c != '\f')
      throw InputError(
          fmt::format("{} there is a byte 0x{:02x}, so this isn't a text file; give an Abaqus or CalculiX "
                      "input file saved as plain text",
                      where(current_place_), byte));
  }
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
    check_text(rest.substr(0, length));
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
  const std::filesystem::path folder = std::filesystem::path(files_[keyword.place.file]).parent_path();
  open((folder / input->second).string(), &keyword.place);
}

}  // namespace railwave
