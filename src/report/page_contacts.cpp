#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "post/contact_command.hpp"
#include "post/contact_tables.hpp"
#include "report/page.hpp"

namespace railwave::page {
namespace {

/// Columns of the nodes, facets and cuts that the page draws.
constexpr const char* node_columns[] = {"along",
                                        "across",
                                        "area",
                                        "touching",
                                        "pressure",
                                        "traction_bound",
                                        "shear_along",
                                        "shear_across",
                                        "micro_slip_along",
                                        "micro_slip_across",
                                        "slips_by_force",
                                        "slips_by_velocity",
                                        "slips_by_solver"};
constexpr const char* facet_corners[] = {"corner_0", "corner_1", "corner_2", "corner_3"};
constexpr const char* cut_columns[] = {"cut", "distance", "pressure", "traction_bound", "shear_along", "shear_across"};

/// Whether the run wrote of it what a contact solution is made of, see docs/results-file.md. Files of earlier versions
/// name no fields, and have all.
bool has_solution(const ResultsReader& results, const std::string& contact) {
  return results.report_damage([&] {
    const hdf5::Group slave = results.contact_group(contact).group("slave");
    if (!slave.has_attribute("fields")) return true;
    const std::string fields = ", " + slave.text_attribute("fields") + ", ";
    const auto has = [&](const char* name) { return fields.find(fmt::format(", {}, ", name)) != std::string::npos; };
    return has("normal_force") && has("tangential_force") && (has("position") || has("displacement"));
  });
}

std::vector<std::uint32_t> whole(const std::vector<double>& numbers) {
  std::vector<std::uint32_t> result;
  for (const double number : numbers) result.push_back(static_cast<std::uint32_t>(number));
  return result;
}

template <std::size_t n>
Json in_levels(const Table& table, const char* const (&columns)[n], PageBlocks& blocks) {
  Json members{{"row", blocks.add(whole(table.values("row")))}};
  for (const char* column : columns) members[column] = blocks.add_in_levels(table.values(column));
  return members;
}

Json facets(const Table& table, PageBlocks& blocks) {
  Json members{{"row", blocks.add(whole(table.values("row")))}};
  for (const char* corner : facet_corners) members[corner] = blocks.add(whole(table.values(corner)));
  return members;
}

Json whole_table(const Table& table, PageBlocks& blocks) {
  Json columns = Json::array();
  for (const Column& column : table.columns())
    columns.push_back(
        Json{{"name", column.name}, {"unit", column.unit}, {"values", blocks.add(table.values(column.name))}});
  return columns;
}

/// Rows 0 of the output times that have nodes, facets and cuts, see ContactRequest::most_detailed.
Json drawn_rows(const Table& patches, const Limits& limits) {
  std::vector<std::size_t> of_all;
  Json drawn = Json::array();
  for (std::size_t row = 0; row < patches.row_count(); ++row)
    if (patches.at(row, "patch") == 0) of_all.push_back(row);
  for (const std::size_t n : evenly_chosen(of_all.size(), limits.instants)) drawn.push_back(of_all[n]);
  return drawn;
}

/// The minor axis of the patch with the largest normal force of all outputs, and the size of the cells in it: the root
/// of the mean area of its nodes.
Json resolution(const Table& patches) {
  std::optional<std::size_t> largest;
  for (std::size_t row = 0; row < patches.row_count(); ++row) {
    const bool counts = patches.at(row, "patch") > 0 && patches.at(row, "small") == 0;
    if (counts && (!largest || patches.at(row, "normal_force") > patches.at(*largest, "normal_force"))) largest = row;
  }
  if (!largest) return nullptr;
  const auto value = [&](const char* column) { return patches.at(*largest, column); };
  return {{"time", value("time")},
          {"patch", value("patch")},
          {"minor_axis", 2 * std::min(value("semi_axis_along"), value("semi_axis_across"))},
          {"cell", std::sqrt(value("area_by_count") / value("nodes_in_contact"))}};
}

}  // namespace

Section contact_section(const ResultsReader& results, const Limits& limits, PageBlocks& blocks) {
  Section section;
  Json contacts = Json::array();
  for (const std::string& name : results.contacts()) {
    if (!has_solution(results, name)) {
      section.notes.push_back(
          fmt::format("contact {}: no patches, because output.contact_fields leaves out normal_force, "
                      "tangential_force, or position",
                      name));
      continue;
    }
    ContactRequest request;
    request.nodes = request.hdf5 = "";  // nodes, facets and cuts are wanted; no file is written
    request.most_detailed = limits.instants;
    const ContactTables tables = contact_tables(results, name, {name}, request);
    const auto& of_all = tables.patches.values("patch");
    const auto outputs = static_cast<std::size_t>(std::count(of_all.begin(), of_all.end(), 0.0));
    section.there.instants = std::max(section.there.instants, outputs);
    if (outputs > limits.instants)
      section.notes.push_back(fmt::format("contact {}: its patches are drawn at {} of {} output times, evenly chosen",
                                          name, limits.instants, outputs));
    contacts.push_back(Json{{"name", name},
                            {"surface", results.slave_surface(name)},
                            {"resolution", resolution(tables.patches)},
                            {"outputs", outputs},
                            {"drawn", drawn_rows(tables.patches, limits)},
                            {"patches", whole_table(tables.patches, blocks)},
                            {"nodes", in_levels(tables.nodes, node_columns, blocks)},
                            {"facets", facets(tables.facets, blocks)},
                            {"cuts", in_levels(tables.cuts, cut_columns, blocks)}});
  }
  section.json = contacts;
  return section;
}

}  // namespace railwave::page
