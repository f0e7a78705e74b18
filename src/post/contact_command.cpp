#include "post/contact_command.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "post/contact_file.hpp"
#include "post/contact_tables.hpp"
#include "post/own_file.hpp"
#include "post/results_reader.hpp"

namespace railwave {
namespace {

void check(const ContactRequest& request) {
  const auto [inner, outer] = request.ring;
  if (!(inner >= 0 && outer > inner && std::isfinite(outer)))
    throw InputError(fmt::format(
        "--ring {},{}: two numbers are wanted, 0 or more, the second the larger one, e.g. --ring 1.5,3", inner, outer));
  const auto& d = request.rolling_direction;
  if (!(std::isfinite(d[0] + d[1] + d[2]) && Vector(d.data()).norm() > 0))
    throw InputError(fmt::format("--rolling-direction {},{},{}: a direction is wanted, e.g. -1,0,0", d[0], d[1], d[2]));
  if (request.axle && request.rolling_velocity)
    throw InputError("--axle and --rolling-velocity exclude each other: name one of them");
  if (request.rolling_velocity && !(*request.rolling_velocity > 0 && std::isfinite(*request.rolling_velocity)))
    throw InputError(
        fmt::format("--rolling-velocity {}: a speed above 0 is wanted, in m/s", *request.rolling_velocity));
  if (!(request.from <= request.to))
    throw InputError(fmt::format("--from {} is after --to {}", request.from, request.to));
  check_wanted_files({request.results},
                     {{"--csv", request.csv, patch_table_kind()},
                      {"--nodes", request.nodes, node_table_kind()},
                      {"--cuts", request.cuts, cut_table_kind()},
                      {"--hdf5", request.hdf5, contact_file_kind()}},
                     request.overwrite);
}

void print_heading(std::ostream& out) {
  out << fmt::format(
      "{:>10} {:>5} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9} {:>9} {:>7} {:>7} {:>17} {:>6} {:>9} "
      "{:>9} {:>9}\n",
      "time", "patch", "nodes", "area", "peak p", "peak p", "peak q", "normal", "creep", "lateral", "T/N", "centre x",
      "centre y", "a", "b", "slipping nodes", "agree", "creepage", "creepage", "spin");
  out << fmt::format(
      "{:>10} {:>5} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9} {:>9} {:>7} {:>7} {:>5} {:>5} {:>5} "
      "{:>6} {:>9} {:>9} {:>9}\n",
      "ms", "", "", "zero mm2", "node MPa", "facet MPa", "node MPa", "kN", "kN", "kN", "", "mm", "mm", "mm", "mm",
      "force", "vel.", "run", "%", "long. %", "lat. %", "1/m");
}

std::string number_or_dash(double value, int decimals) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, decimals);
}

/// A row of the patches' table; several patches together are summed up in their own row 0 of it.
void print_row(std::ostream& out, const Table& t, std::size_t row) {
  const auto value = [&](const char* column, double unit = 1) { return unit * t.at(row, column); };
  const bool all = value("patch") == 0;
  out << fmt::format(
      "{:>10.5f} {:>5} {:>6} {:>9.2f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.3f} {:>9.3f} {:>9.3f} {:>8.4f} {:>9} {:>9} "
      "{:>7.3f} {:>7.3f} {:>5} {:>5} {:>5} "
      "{:>6} {:>9} {:>9} {:>9}\n",
      value("time", 1e3), all ? "all" : fmt::format("{}{}", value("patch"), value("small") > 0 ? "*" : ""),
      value("nodes_in_contact"), value("area", 1e6), value("peak_nodal_pressure", 1e-6),
      value("peak_facet_pressure", 1e-6), value("peak_shear", 1e-6), value("normal_force", 1e-3),
      value("creep_force", 1e-3), value("lateral_force", 1e-3), value("traction_coefficient"),
      number_or_dash(value("centre_x", 1e3), 3), number_or_dash(value("centre_y", 1e3), 3),
      value("semi_axis_along", 1e3), value("semi_axis_across", 1e3), value("slipping_by_force"),
      value("slipping_by_velocity"), number_or_dash(value("slipping_by_solver"), 0),
      number_or_dash(value("agreement_force_velocity", 100), 1), number_or_dash(value("longitudinal_creepage", 100), 4),
      number_or_dash(value("lateral_creepage", 100), 4), number_or_dash(value("spin_creepage"), 3));
}

/// Row 0, of all patches together, says nothing new where there is one.
void print(std::ostream& out, const Table& patches) {
  print_heading(out);
  bool any_small = false;
  for (std::size_t row = 0; row < patches.row_count(); ++row) {
    const bool all = patches.at(row, "patch") == 0;
    const bool last_of_instant = row + 1 == patches.row_count() || patches.at(row + 1, "patch") == 0;
    const bool followed_by_one =
        !last_of_instant && (row + 2 == patches.row_count() || patches.at(row + 2, "patch") == 0);
    if (!all || !(followed_by_one && patches.at(row, "stray_nodes") == 0)) print_row(out, patches, row);
    any_small = any_small || patches.at(row, "small") > 0;
  }
  if (any_small)
    out << fmt::format("* fewer than {} nodes: too few for the mesh to show its shape, stress and slip\n",
                       smallest_patch);
}

/// Contacts that are one contact solution.
struct Solution {
  std::string name;
  std::vector<std::string> contacts;
};

/// The contacts of the file, those that the request names together at the place of the first of them.
std::vector<Solution> wanted_solutions(const std::vector<std::string>& contacts, const ContactRequest& request) {
  std::vector<Solution> solutions;
  std::set<std::string> taken;
  for (const std::string& list : request.together) {
    Solution solution;
    std::stringstream names(list);
    for (std::string name; std::getline(names, name, ',');) {
      if (std::find(contacts.begin(), contacts.end(), name) == contacts.end())
        throw InputError(
            fmt::format("--together {}: there is no contact '{}'; {}", list, name, suggestion(name, contacts)));
      if (!taken.insert(name).second)
        throw InputError(
            fmt::format("--together {}: '{}' is named twice; each contact is of one solution", list, name));
      solution.contacts.push_back(name);
      solution.name += (solution.name.empty() ? "" : "+") + name;
    }
    if (solution.contacts.size() < 2)
      throw InputError(
          fmt::format("--together {}: two or more contacts are wanted, e.g. --together tread,tread_2", list));
    solutions.push_back(solution);
  }
  for (const std::string& contact : contacts)
    if (taken.count(contact) == 0) solutions.push_back({contact, {contact}});
  std::sort(solutions.begin(), solutions.end(), [](const Solution& a, const Solution& b) { return a.name < b.name; });
  return solutions;
}

/// Names of the slave surfaces, each once, joined by ", ".
std::string slave_surfaces(const ResultsReader& results, const Solution& solution) {
  std::string text;
  std::set<std::string> named;
  for (const std::string& contact : solution.contacts)
    if (const std::string surface = results.slave_surface(contact); named.insert(surface).second)
      text += (text.empty() ? "" : ", ") + surface;
  return text;
}

}  // namespace

int contact_command(const ContactRequest& request, std::ostream& out) {
  check(request);
  const ResultsReader results(request.results);
  const std::vector<std::string> contacts = results.contacts();
  if (contacts.empty()) {
    throw InputError(
        fmt::format("results file {} holds no contact: the case has no [contacts.NAME], or the run ended before its "
                    "first output of fields",
                    request.results));
  }
  if (!results.completed()) out << "note: this run did not complete: " << results.reason() << '\n';
  std::vector<std::pair<std::string, ContactTables>> solved;
  std::vector<std::string> surfaces;
  for (const Solution& solution : wanted_solutions(contacts, request)) {
    solved.emplace_back(solution.name, contact_tables(results, solution.name, solution.contacts, request));
    surfaces.push_back(slave_surfaces(results, solution));
    out << fmt::format("contact {}, forces on {}\n", solution.name, surfaces.back());
    print(out, solved.back().second.patches);
  }
  const auto csv = [&](Table ContactTables::*table) {
    std::string text = (solved.front().second.*table).csv_heading();
    for (const auto& [contact, tables] : solved) text += (tables.*table).csv_rows(contact);
    return text;
  };
  if (request.csv) write_table(*request.csv, csv(&ContactTables::patches), patch_table_kind());
  if (request.nodes) write_table(*request.nodes, csv(&ContactTables::nodes), node_table_kind());
  if (request.cuts) write_table(*request.cuts, csv(&ContactTables::cuts), cut_table_kind());
  if (request.hdf5) write_contact_file(*request.hdf5, results, solved, surfaces);
  return 0;
}

}  // namespace railwave
