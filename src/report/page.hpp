#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "output/file_kind.hpp"
#include "post/history_series.hpp"
#include "post/results_reader.hpp"
#include "report/page_blocks.hpp"

/// A page is its template, filled with what it says of each results file, section by section: each is JSON, with its
/// arrays among the blocks. All numbers are in SI units.
namespace railwave::page {

/// How much of a run goes into a page.
struct Limits {
  std::size_t instants = 60;   ///< of contact patches and of fields, each
  std::size_t samples = 4000;  ///< of each history
};

/// A section's JSON, what was left out of it, for the page and for people at the terminal, and how much there is.
struct Section {
  Json json;
  std::vector<std::string> notes = {};
  Limits there{0, 0};
};

/// What the run was and how it ended: title, program, steps, warnings of the monitor, the case's text, and the energy
/// balance: its largest error and the largest elastic energy with plastic work, J.
Section summary_section(const ResultsReader& results, const HistoryTable& history);

/// All histories. Where there are more samples than the limit each channel has the smallest and the largest value of
/// equal stretches of time.
Section history_section(const HistoryTable& history, const Limits& limits, PageBlocks& blocks);

/// Of each contact: the table of `railwave contact` at all output times, nodes, facets and cuts at some of them, and
/// how many cells lie across the minor axis of its patch where the normal force is largest.
Section contact_section(const ResultsReader& results, const Limits& limits, PageBlocks& blocks);

/// The outer faces of each set of /fields, at some output times: rigid motion (least squares), what of the
/// displacement it does not explain, and all fields.
Section field_section(const ResultsReader& results, const Limits& limits, PageBlocks& blocks);

/// Reads the page without data: share/railwave/report.html beside the folder of the program, else the one that
/// scripts/setup --report has made in the source tree. Throws InputError that says how it is made where there is none,
/// and where it has no place for the data.
std::string page_template();
bool has_page_template();

/// The template with data in its place.
/// @param blocks elements of HTML that come before the data
/// @param json that the page starts from
std::string filled(const std::string& page, const std::string& blocks, const Json& json);

/// By what a report is known again.
FileKind report_kind();

/// What to call each of several files: their paths without the folders and names that all have in common.
std::vector<std::string> short_names(const std::vector<std::string>& paths);

}  // namespace railwave::page
