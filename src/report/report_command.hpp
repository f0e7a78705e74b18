#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace railwave {

/// What `railwave report` is asked for.
struct ReportRequest {
  std::vector<std::string> results;  ///< results files of runs, shown side by side
  std::optional<std::string> out;    ///< HTML file to write; see report_path()
  std::size_t instants = 60;         ///< of contact patches and of fields, each at most
  double size = 14;                  ///< MB of the page: above it, fewer instants and samples
  bool overwrite = false;            ///< files of others too
};

/// Where the page is written: `out`, else RESULTS with the ending .html, of several report.html beside the first.
std::string report_path(const ReportRequest& request);

/// Writes one HTML file that shows the results, without any network: all that docs/report.md says. The page's own
/// scripts and styles come from its template, see page_template() in page.hpp.
/// @param program name and version of this program, for the page
/// @param out gets what was left out of the page, and where the page is
/// @return the exit code 0; throws InputError for a file or request that cannot be used
int report_command(const ReportRequest& request, const std::string& program, std::ostream& out);

}  // namespace railwave
