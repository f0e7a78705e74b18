#include "mesh/files/dyna_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

namespace fs = std::filesystem;

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

bool is_there(const fs::path& path) {
  std::error_code failed;
  return fs::exists(path, failed);
}

}  // namespace

std::vector<std::pair<std::string, FilePlace>> dyna_file_names(const std::vector<DynaLine>& lines, std::size_t most) {
  std::vector<std::pair<std::string, FilePlace>> names;
  bool goes_on = false;
  for (const DynaLine& line : lines) {
    std::string_view text = trim(line.text);
    if (text.empty()) continue;
    if (!goes_on && names.size() == most) break;
    const bool more = text.size() >= 2 && text.substr(text.size() - 2) == " +";
    if (more) text = trim(text.substr(0, text.size() - 2));
    if (goes_on)
      names.back().first += text;
    else
      names.emplace_back(text, line.place);
    goes_on = more;
  }
  // Decks made under Windows.
  for (auto& [name, place] : names) std::replace(name.begin(), name.end(), '\\', '/');
  return names;
}

DynaLines::DynaLines(const std::string& path, std::vector<std::string>& files) : files_(files) {
  open(path, nullptr, 0);
}

int DynaLines::add_scope(const DynaScope& scope) {
  scopes_.push_back(scope);
  return static_cast<int>(scopes_.size()) - 1;
}

void DynaLines::open(const std::string& path, const FilePlace* from, int scope) {
  texts_.push_back(std::make_unique<std::string>(files_.open(path, from)));
  sources_.push_back(
      {*texts_.back(), files_.last(), scope, sources_.empty() ? DynaFormat::standard : sources_.back().format});
}

void DynaLines::check_text(std::string_view line) const {
  files_.check_text(line, current_place_, "an LS-DYNA keyword deck", "\x1a");
  if (line.substr(0, 14) == "-----BEGIN PGP")
    throw InputError(
        fmt::format("{} the deck is encrypted from here on, which only LS-DYNA can read; ask whoever "
                    "made it for the plain text",
                    where(current_place_)));
}

bool DynaLines::fill() {
  while (!filled_ && !sources_.empty()) {
    Source& source = sources_.back();
    if (source.offset >= source.text.size()) {
      sources_.pop_back();
      continue;
    }
    const std::string_view rest = source.text.substr(source.offset);
    const auto length = std::min(rest.find('\n'), rest.size());
    source.offset += length + 1;
    current_place_ = {source.file, ++source.line};
    current_ = rest.substr(0, length);
    while (!current_.empty() && (current_.back() == '\r' || current_.back() == '\x1a')) current_.remove_suffix(1);
    check_text(current_);
    filled_ = current_.empty() || current_[0] != '$';
  }
  return filled_;
}

std::optional<DynaKeyword> DynaLines::next() {
  while (fill()) {
    if (current_.empty() || current_[0] != '*') {
      if (!trim(current_).empty())
        throw InputError(fmt::format(
            "{} '{}' stands where a keyword is expected; a keyword deck begins with a line such as *KEYWORD",
            where(current_place_), for_message(trim(current_))));
      filled_ = false;
      continue;
    }
    DynaKeyword keyword = read_keyword();
    if (keyword.name == "END") {
      sources_.back().offset = sources_.back().text.size();
      filled_ = false;
      continue;
    }
    // The data end with the file: those of the file around it belong to the inclusion before.
    const int file = current_place_.file;
    while (fill() && current_place_.file == file && (current_.empty() || current_[0] != '*')) {
      keyword.lines.push_back({current_, current_place_});
      filled_ = false;
    }
    if (keyword.name == "INCLUDE" || keyword.name == "INCLUDE_PATH" || keyword.name == "INCLUDE_PATH_RELATIVE")
      obey_include(keyword);
    else
      return keyword;
  }
  return std::nullopt;
}

DynaKeyword DynaLines::read_keyword() {
  DynaKeyword keyword;
  keyword.place = current_place_;
  keyword.scope = sources_.back().scope;
  keyword.format = sources_.back().format;
  filled_ = false;
  const std::string_view line = trim(current_.substr(1));
  auto end = std::min(line.find_first_of(" \t,("), line.size());
  while (end > 0 && std::string_view("+-%").find(line[end - 1]) != std::string_view::npos) --end;
  keyword.name = upper_case(line.substr(0, end));
  set_format(keyword, line.substr(end));
  return keyword;
}

void DynaLines::set_format(DynaKeyword& keyword, std::string_view rest) {
  std::string options = upper_case(rest);
  if (keyword.name == "KEYWORD") {
    options.erase(std::remove(options.begin(), options.end(), ' '), options.end());
    const auto has = [&](const char* option) { return options.find(option) != std::string::npos; };
    DynaFormat& format = sources_.back().format;
    if (has("LONG=Y") || has("LONG=K"))
      format = DynaFormat::twenty;
    else if (has("LONG=S") && format == DynaFormat::twenty)
      format = DynaFormat::standard;
    else if (has("I10=Y") && format == DynaFormat::standard)
      format = DynaFormat::ten;
    // LONG=S only says how LS-DYNA writes its own decks.
    return;
  }
  const std::string_view mark = trim(options);
  if (mark == "+") keyword.format = DynaFormat::twenty;
  if (mark == "-") keyword.format = DynaFormat::standard;
  if (mark == "%") keyword.format = DynaFormat::ten;
}

std::string DynaLines::find(const std::string& name, const FilePlace& from) const {
  if (fs::path(name).is_absolute()) return name;
  const fs::path beside = fs::path(files_.path(from.file)).parent_path(), main = fs::path(files_.path(0)).parent_path();
  std::vector<fs::path> places{main / name, beside / name};
  for (const std::string& folder : folders_) {
    places.push_back(fs::path(folder) / name);
    places.push_back(main / folder / name);
  }
  for (const fs::path& place : places)
    if (is_there(place)) return place.string();
  return places.front().string();
}

void DynaLines::include(const std::vector<std::pair<std::string, FilePlace>>& names, int scope) {
  // What was looked at beyond the data comes after the inclusion: it is read again.
  if (filled_) {
    Source& source = sources_.back();
    source.offset = static_cast<std::size_t>(current_.data() - source.text.data());
    --source.line;
    filled_ = false;
  }
  // The first is to be read first, so that it goes on top.
  for (auto name = names.rbegin(); name != names.rend(); ++name)
    open(find(name->first, name->second), &name->second, scope);
}

void DynaLines::obey_include(const DynaKeyword& keyword) {
  const auto names = dyna_file_names(keyword.lines, keyword.lines.size());
  if (names.empty())
    throw InputError(fmt::format("{} *{} names nothing; write a file or folder in the next line", where(keyword.place),
                                 keyword.name));
  if (keyword.name == "INCLUDE") return include(names, keyword.scope);
  for (const auto& name : names) add_folder(name.first);
}

}  // namespace railwave
