#include <ostream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "post/contact_solution.hpp"
#include "post/results_reader.hpp"

namespace railwave {
namespace {

const char* const csv_heading =
    "contact,time,nodes_in_contact,area_by_count,area,peak_nodal_pressure,peak_facet_pressure,peak_shear,normal_force,creep_force,"
    "lateral_force,traction_coefficient,centre_x,centre_y,centre_z,normal_x,normal_y,normal_z,slipping_by_force,slipping_by_velocity,"
    "slipping_by_solver\n";

/// A name with commas or quotes is put in quotes, as spreadsheets expect it.
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_line(const std::string& contact, double time, const ContactSolution& s) {
  return fmt::format("{},{:.12g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{},{}\n",
                     csv_text(contact), time, s.nodes, s.area_by_count, s.area, s.peak_nodal_pressure, s.peak_facet_pressure, s.peak_shear,
                     s.normal_force, s.creep_force, s.lateral_force, s.traction_coefficient, s.centre[0], s.centre[1], s.centre[2],
                     s.normal[0], s.normal[1], s.normal[2], s.slipping_by_force, s.slipping_by_velocity, s.slipping_by_solver);
}

void print_heading(std::ostream& out) {
  out << fmt::format("{:>10} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9} {:>9} {:>17}\n", "time", "nodes", "area", "area",
                     "peak p", "peak p", "peak q", "normal", "creep", "lateral", "T/N", "centre x", "centre y", "slipping nodes");
  out << fmt::format("{:>10} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9} {:>9} {:>5} {:>5} {:>5}\n", "ms", "", "count mm2",
                     "zero mm2", "node MPa", "facet MPa", "node MPa", "kN", "kN", "kN", "", "mm", "mm", "force", "vel.", "run");
}

void print_line(std::ostream& out, double time, const ContactSolution& s) {
  out << fmt::format("{:>10.5f} {:>6} {:>9.2f} {:>9.2f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.3f} {:>9.3f} {:>9.3f} {:>8.4f} {:>9.3f} {:>9.3f} {:>5} {:>5} {:>5}\n",
                     1e3 * time, s.nodes, 1e6 * s.area_by_count, 1e6 * s.area, 1e-6 * s.peak_nodal_pressure, 1e-6 * s.peak_facet_pressure,
                     1e-6 * s.peak_shear, 1e-3 * s.normal_force, 1e-3 * s.creep_force, 1e-3 * s.lateral_force, s.traction_coefficient,
                     1e3 * s.centre[0], 1e3 * s.centre[1], s.slipping_by_force, s.slipping_by_velocity, s.slipping_by_solver);
}

}  // namespace

int contact_command(const std::string& file, const std::optional<std::string>& csv, std::ostream& out) {
  const ResultsReader results(file);
  const std::vector<std::string> contacts = results.contacts();
  if (contacts.empty()) {
    throw InputError(fmt::format(
        "results file {} holds no contact: the case has no [contacts.NAME], or the run ended before its first output of fields", file));
  }
  std::string table = csv_heading;
  if (!results.completed()) out << "note: this run did not complete: " << results.reason() << '\n';
  for (const std::string& contact : contacts) {
    const std::vector<double> times = results.contact_times(contact);
    out << fmt::format("contact {}, forces on {}\n", contact, results.slave_surface(contact));
    print_heading(out);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const ContactSolution solution = contact_solution(results.contact_state(contact, i));
      print_line(out, times[i], solution);
      table += csv_line(contact, times[i], solution);
    }
  }
  if (csv) {
    try {
      write_whole_file(*csv, table);
    } catch (const std::exception& error) {
      throw InputError(fmt::format("the table was not written: {}", error.what()));
    }
  }
  return 0;
}

}  // namespace railwave
