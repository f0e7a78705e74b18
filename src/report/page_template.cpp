#include "report/page.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/shared_files.hpp"

namespace railwave::page {
namespace {

namespace fs = std::filesystem;

constexpr const char* place_of_data = "<!--railwave-data-->";

/// Where the template may lie, in the order in which it is looked for.
std::vector<std::string> places() { return places_of("report.html", RAILWAVE_REPORT_TEMPLATE); }

/// Without the hash that ends the name of a sweep's member (-0123456789ab), where all have one and differ
/// without it.
std::vector<std::string> without_hashes(const std::vector<std::string>& names) {
  constexpr std::size_t length = 13;
  std::vector<std::string> bare;
  for (const std::string& name : names) {
    const std::size_t at = name.size() > length ? name.size() - length : 0;
    if (at == 0 || name[at] != '-' || name.find_first_not_of("0123456789abcdef", at + 1) != std::string::npos)
      return names;
    bare.push_back(name.substr(0, at));
  }
  return std::set<std::string>(bare.begin(), bare.end()).size() == bare.size() ? bare : names;
}

}  // namespace

bool has_page_template() { return !first_present(places()).empty(); }

std::string page_template() {
  for (const std::string& path : places()) {
    std::ifstream file(path, std::ios::binary);
    if (!file) continue;
    const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (page.find(place_of_data) == std::string::npos)
      throw InputError(
          fmt::format("{} is no page that a report can be made of; scripts/setup --report makes it again", path));
    return page;
  }
  std::string looked;
  for (const std::string& path : places()) looked += (looked.empty() ? "" : " and ") + path;
  throw InputError(
      fmt::format("the page that a report is made of is not there (looked for {}): scripts/setup --report makes it, "
                  "with libraries from npm",
                  looked));
}

std::string filled(const std::string& page, const std::string& blocks, const Json& json) {
  const std::size_t at = page.find(place_of_data);
  return page.substr(0, at) + blocks + "<script type=\"application/json\" id=\"railwave-data\">" + text_for_html(json) +
         "</script>" + page.substr(at + std::string(place_of_data).size());
}

FileKind report_kind() { return {FileKind::Form::text, "a report of 'railwave report'", "Railwave report", ""}; }

std::vector<std::string> short_names(const std::vector<std::string>& paths) {
  std::vector<std::vector<std::string>> parts;
  for (const std::string& path : paths) {
    const fs::path whole = fs::path(path).lexically_normal().replace_extension();
    parts.emplace_back();
    for (const fs::path& part : whole) parts.back().push_back(part.string());
  }
  const auto all_same = [&](bool at_end) {
    return std::all_of(parts.begin(), parts.end(), [&](const std::vector<std::string>& one) {
      const auto& first = parts.front();
      return one.size() > 1 && (at_end ? one.back() == first.back() : one.front() == first.front());
    });
  };
  if (paths.size() > 1)
    while (all_same(true))
      for (auto& one : parts) one.pop_back();
  while (all_same(false))
    for (auto& one : parts) one.erase(one.begin());
  std::vector<std::string> names;
  for (const auto& one : parts) {
    names.emplace_back();
    for (const std::string& part : one) names.back() += (names.back().empty() ? "" : "/") + part;
  }
  return without_hashes(names);
}

}  // namespace railwave::page
