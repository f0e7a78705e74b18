#include "report/report_command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "output/output_place.hpp"
#include "report/page.hpp"

namespace railwave {
namespace {

using report::json_list;
using report::json_object;
using report::json_text;

constexpr double bytes_in_megabyte = 1e6;
constexpr std::size_t fewest_instants = 2, fewest_samples = 100;

void check(const ReportRequest& request) {
  OutputPlaces places(request.overwrite);
  for (const std::string& path : request.results) places.reads(path, "the results file");
  places.writes(report_path(request), report::report_kind(), "--out", "the report");
  places.check();
}

/// What the page shows of a results file, and the notes of all its sections.
std::string result_json(const std::string& path, const std::string& name, const report::Limits& limits,
                        report::PageBlocks& blocks, std::vector<std::string>& notes) {
  const ResultsReader results(path);
  const HistoryTable history = read_history_table(results);
  std::vector<std::string> own;
  const auto json_of = [&](const report::Section& section) {
    own.insert(own.end(), section.notes.begin(), section.notes.end());
    return section.json;
  };
  const std::vector<std::pair<std::string, std::string>> sections{
      {"summary", json_of(report::summary_section(results, history))},
      {"history", json_of(report::history_section(history, limits, blocks))},
      {"contacts", json_of(report::contact_section(results, limits, blocks))},
      {"fields", json_of(report::field_section(results, limits, blocks))}};
  std::vector<std::pair<std::string, std::string>> members{{"name", json_text(name)}, {"file", json_text(path)}};
  members.insert(members.end(), sections.begin(), sections.end());
  std::vector<std::string> texts;
  for (const std::string& note : own) {
    texts.push_back(json_text(note));
    notes.push_back(name + ": " + note);
  }
  members.emplace_back("notes", json_list(texts));
  return json_object(members);
}

std::string whole_page(const ReportRequest& request, const std::string& program, const report::Limits& limits,
                       std::vector<std::string>& notes) {
  const std::string page = report::page_template();
  const std::vector<std::string> names = report::short_names(request.results);
  report::PageBlocks blocks;
  std::vector<std::string> results;
  notes.clear();
  for (std::size_t i = 0; i < request.results.size(); ++i)
    results.push_back(result_json(request.results[i], names[i], limits, blocks, notes));
  return report::filled(page, blocks.html(),
                        json_object({{"program", json_text(program)}, {"results", json_list(results)}}));
}

}  // namespace

std::string report_path(const ReportRequest& request) {
  if (request.out) return *request.out;
  const std::filesystem::path first(request.results.front());
  if (request.results.size() == 1) return std::filesystem::path(first).replace_extension(".html").string();
  return (first.parent_path() / "report.html").string();
}

int report_command(const ReportRequest& request, const std::string& program, std::ostream& out) {
  check(request);
  report::Limits limits;
  limits.instants = request.instants;
  std::vector<std::string> notes;
  std::string page = whole_page(request, program, limits, notes);
  const double wanted = request.size * bytes_in_megabyte;
  while (static_cast<double>(page.size()) > wanted &&
         (limits.instants > fewest_instants || limits.samples > fewest_samples)) {
    const double share = std::min(0.8, wanted / static_cast<double>(page.size()));
    const auto fewer = [&](std::size_t count, std::size_t least) {
      return std::max(least, static_cast<std::size_t>(share * static_cast<double>(count)));
    };
    limits.instants = fewer(limits.instants, fewest_instants);
    limits.samples = fewer(limits.samples, fewest_samples);
    page = whole_page(request, program, limits, notes);
  }
  const std::string path = report_path(request);
  try {
    write_whole_file(path, page, report::report_kind());
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("the report was not written: {}", error.what()));
  }
  for (const std::string& note : notes) out << "note: " << note << '\n';
  const double size = static_cast<double>(page.size()) / bytes_in_megabyte;
  if (static_cast<double>(page.size()) > wanted)
    out << fmt::format("note: the page has {:.1f} MB, more than --size {}, with the fewest instants and samples\n",
                       size, request.size);
  out << fmt::format("report: {} ({:.1f} MB), opens in any browser\n", path, size);
  return 0;
}

}  // namespace railwave
