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

using page::Json;

constexpr double bytes_in_megabyte = 1e6;
constexpr page::Limits fewest{2, 100};

void check(const ReportRequest& request) {
  OutputPlaces places(request.overwrite);
  for (const std::string& path : request.results) places.reads(path, "the results file");
  places.writes(report_path(request), page::report_kind(), "--out", "the report");
  places.check();
}

/// A page as text, and what there would be to show.
struct Page {
  std::string text;
  std::vector<std::string> notes;
  page::Limits there{0, 0};
  std::size_t empty = 0;  ///< bytes without data
};

/// What the page shows of a results file.
Json result_json(const std::string& path, const std::string& name, const page::Limits& limits, page::PageBlocks& blocks,
                 Page& whole) {
  const ResultsReader results(path);
  const HistoryTable history = read_history_table(results);
  Json notes = Json::array();
  const auto json_of = [&](const page::Section& section) {
    for (const std::string& note : section.notes) {
      notes.push_back(note);
      whole.notes.push_back(name + ": " + note);
    }
    whole.there.instants = std::max(whole.there.instants, section.there.instants);
    whole.there.samples = std::max(whole.there.samples, section.there.samples);
    return section.json;
  };
  Json members{{"name", name}, {"file", path}};
  members["summary"] = json_of(page::summary_section(results, history));
  members["history"] = json_of(page::history_section(history, limits, blocks));
  members["contacts"] = json_of(page::contact_section(results, limits, blocks));
  members["fields"] = json_of(page::field_section(results, limits, blocks));
  members["notes"] = notes;
  return members;
}

Page page_within(const ReportRequest& request, const std::string& program, const page::Limits& limits) {
  const std::string empty = page::page_template();
  const std::vector<std::string> names = page::short_names(request.results);
  Page whole;
  page::PageBlocks blocks;
  Json results = Json::array();
  for (std::size_t i = 0; i < request.results.size(); ++i)
    results.push_back(result_json(request.results[i], names[i], limits, blocks, whole));
  const Json json{{"program", program}, {"results", results}};
  whole.text = page::filled(empty, blocks.html(), json);
  whole.empty = empty.size();
  return whole;
}

/// The page with as many instants and samples as are asked for, or with so many fewer that it has the size asked for.
Page page_of_size(const ReportRequest& request, const std::string& program) {
  page::Limits limits;
  limits.instants = request.instants;
  Page whole = page_within(request, program, limits);
  const double wanted = request.size * bytes_in_megabyte;
  while (static_cast<double>(whole.text.size()) > wanted &&
         (limits.instants > fewest.instants || limits.samples > fewest.samples)) {
    const double room = std::max(0.0, wanted - static_cast<double>(whole.empty)),
                 share = std::min(0.9, room / static_cast<double>(whole.text.size() - whole.empty));
    const auto fewer = [&](std::size_t limit, std::size_t there, std::size_t least) {
      return std::max(least, static_cast<std::size_t>(share * static_cast<double>(std::min(limit, there))));
    };
    limits.instants = fewer(limits.instants, whole.there.instants, fewest.instants);
    limits.samples = fewer(limits.samples, whole.there.samples, fewest.samples);
    whole = page_within(request, program, limits);
  }
  return whole;
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
  const Page whole = page_of_size(request, program);
  const std::string path = report_path(request);
  try {
    write_whole_file(path, whole.text, page::report_kind());
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("the report was not written: {}", error.what()));
  }
  for (const std::string& note : whole.notes) out << "note: " << note << '\n';
  const double size = static_cast<double>(whole.text.size()) / bytes_in_megabyte;
  if (size > request.size)
    out << fmt::format("note: the page has {:.1f} MB, more than --size {}, with the fewest instants and samples\n",
                       size, request.size);
  out << fmt::format("report: {} ({:.1f} MB), opens in any browser\n", path, size);
  return 0;
}

}  // namespace railwave
