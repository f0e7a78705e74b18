#include "output/results_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <numeric>

#include "case/error.hpp"
#include "case/field_table.hpp"
#include "case/memory.hpp"
#include "mesh/hexahedron.hpp"
#include "output/histories/history_values.hpp"

namespace railwave {
namespace {

// m, along the rail and across it: a usual patch of wheel and rail.
constexpr double usual_patch[2] = {0.015, 0.012};

/// Of an output set at one output.
double bytes_of(const OutputSet& set, const RunDescription& description) {
  double bytes = set.is_beam() ? 6.0 * sizeof(double) * static_cast<double>(set.elements.size()) : 0;
  for (const std::string& name : description.fields)
    if (const FieldRow& row = field_named(name); set.has(row))
      bytes += static_cast<double>(description.format.bytes() * row.components * set.numbers(row).size());
  return bytes;
}

/// Nodes of a surface that are written: about one a facet; near the contact as many as the fine facets have in the box
/// around a usual patch.
double nodes_written(const std::vector<Face>& facets, const Assembly& assembly, std::optional<double> margin) {
  const auto count = static_cast<double>(facets.size());
  if (!margin || facets.empty()) return count;
  std::vector<double> areas;
  for (const Face& face : facets) {
    const auto corners = assembly.face_nodes(face);
    areas.push_back(facet_area(assembly.nodes[corners[0]], assembly.nodes[corners[1]], assembly.nodes[corners[2]],
                               assembly.nodes[corners[3]]));
  }
  const auto fine = areas.begin() + static_cast<long>(areas.size() / 20);
  std::nth_element(areas.begin(), fine, areas.end());
  return std::fmin(count, (usual_patch[0] + 2 * *margin) * (usual_patch[1] + 2 * *margin) / std::fmax(*fine, 1e-12));
}

/// Of a contact at one output.
double bytes_of(const ContactDescription& contact, const RunDescription& description, const Assembly& assembly) {
  const ContactOutput& output = description.contact_output;
  double bytes = 0;
  const auto add_surface = [&](const std::string& surface, bool slave) {
    const auto found = assembly.surfaces.find(surface);
    if (found == assembly.surfaces.end() || !output.has_side(slave)) return;
    double of_node = output.near_only() ? sizeof(int) : 0;
    for (const ContactFieldRow& row : contact_field_table())
      if (has_values(row, slave, contact.falling_friction) && output.has_any({row.name}))
        of_node += static_cast<double>(output.format.bytes() * row.components);
    bytes += of_node * nodes_written(found->second, assembly, output.margin);
  };
  add_surface(contact.slave, true);
  for (const std::string& master : contact.master) add_surface(master, false);
  return bytes;
}

double components_of(const std::vector<const FieldRow*>& rows) {
  double components = 0;
  for (const FieldRow* row : rows) components += row->components;
  return components;
}

double values_of_sample(const RunDescription& description) {
  const double motion = components_of(fields_for(FieldRow::histories, FieldRow::Place::node));
  double values = 2 + static_cast<double>(std::size(energy_terms)) +
                  11.0 * static_cast<double>(description.contacts.size()) +
                  motion * static_cast<double>(description.history_sets.size()) +
                  4.0 * static_cast<double>(description.loads.size() + description.prescribed_motions.size());
  for (const auto& beam : description.beams) values += 6.0 * beam.second;
  for (const HistorySet& set : description.element_histories)
    values += components_of(set.quantities_of(FieldRow::Place::element));
  return values;
}

/// Outputs of a run: never more than its steps.
double times_of(double interval, double end, double steps) {
  return 2 + (interval > 0 ? std::min(end / interval, steps) : steps);
}

double times_of_window(const scene::OutputWindow& window, double end, double step) {
  const double length = std::fmin(end, window.end.value_or(end)) - window.start;
  return 1 + length / std::fmax(window.interval, step);
}

}  // namespace

ResultsSize results_size(const RunDescription& description, const AssembledScene& assembled, const StepSizes& sizes) {
  const scene::Output& output = assembled.scene.output;
  const auto& output_windows = assembled.scene.output_windows;
  const auto steps = static_cast<double>(sizes.step_count);
  const double end = assembled.scene.time.end;
  ResultsSize size;
  std::vector<double> of_sets, of_contacts;
  for (const OutputSet& set : description.sets) of_sets.push_back(bytes_of(set, description));
  for (const ContactDescription& contact : description.contacts)
    of_contacts.push_back(bytes_of(contact, description, assembled.assembly));
  const double all = std::accumulate(of_sets.begin(), of_sets.end(), 0.0) +
                     std::accumulate(of_contacts.begin(), of_contacts.end(), 0.0);
  size.field_outputs = output.field_interval > 0 ? times_of(sizes.output_times.fields, end, steps) : 2;
  size.field_bytes = size.field_outputs * all;
  for (std::size_t w = 0; w < output_windows.size(); ++w) {
    const double times = times_of_window(output_windows[w], end, sizes.step_size);
    const OutputChoice& choice = description.windows[w];
    size.field_outputs += times;
    for (std::size_t s = 0; s < of_sets.size(); ++s)
      if (choice.sets[s]) size.field_bytes += times * of_sets[s];
    for (std::size_t c = 0; c < of_contacts.size(); ++c)
      if (choice.contacts[c]) size.field_bytes += times * of_contacts[c];
  }
  size.samples = times_of(sizes.output_times.history, end, steps);
  size.history_bytes = 8 * size.samples * values_of_sample(description);
  return size;
}

std::string describe(const ResultsSize& size) {
  return fmt::format(
      "Results: {:.0f} outputs of fields and contacts, {} each, {} before compression; {:.0f} samples of "
      "histories, {} each, {}",
      size.field_outputs, bytes_text(size.field_bytes / size.field_outputs), bytes_text(size.field_bytes), size.samples,
      bytes_text(size.history_bytes / size.samples), bytes_text(size.history_bytes));
}

void check_results_disk_space(const ResultsSize& size, const scene::Scene& scene, double available) {
  // Stresses of a body that swings all through keep about two thirds, of one that mostly rests nearly nothing.
  constexpr double least_share = 0.02;
  if (size.history_bytes + least_share * size.field_bytes <= available) return;
  const bool fields = least_share * size.field_bytes > size.history_bytes;
  const std::string longer = !fields                        ? "history_interval"
                             : scene.output_windows.empty() ? "field_interval"
                                                            : "field_interval and interval of [output_windows]";
  throw InputError(fmt::format(
      "{}: [output] {} makes {:.3g} {} of {} each: {}{}{} has {} free; give a longer {}, {}, "
      "end the run (time.end = {:.4g} s) earlier, "
      "see whether the step is as long as it should be, or name a file on a larger disk",
      scene.path, fields ? "field_interval" : "history_interval", fields ? size.field_outputs : size.samples,
      fields ? "outputs of fields" : "samples of histories",
      fields ? bytes_text(size.field_bytes / size.field_outputs) : bytes_text(size.history_bytes / size.samples),
      bytes_text(fields ? size.field_bytes : size.history_bytes), disk_too_small, scene.output.file,
      bytes_text(available), longer, fields ? "fewer field_sets or fields" : "fewer history_sets", scene.time.end));
}

double free_bytes_at(const std::string& path) {
  std::error_code failed;
  const auto space = std::filesystem::space(std::filesystem::absolute(path).parent_path(), failed);
  return failed ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

}  // namespace railwave
