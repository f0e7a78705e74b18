#include "output/results_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>

#include "case/error.hpp"
#include "case/field_table.hpp"
#include "case/memory.hpp"
#include "output/histories/history_values.hpp"

namespace railwave {
namespace {

/// Values of each node of a contact surface at each output, see contact_section.cpp.
constexpr double values_of_contact_node = 23;

double values_of_output(const RunDescription& description, const Assembly& assembly) {
  double values = 0;
  for (const OutputSet& set : description.sets) {
    if (set.is_beam()) values += 6.0 * static_cast<double>(set.elements.size());
    for (const std::string& name : description.fields)
      if (const FieldRow& row = field_named(name); set.has(row))
        values += row.components * static_cast<double>(set.numbers(row).size());
  }
  const auto add_surface = [&](const std::string& surface) {
    if (const auto found = assembly.surfaces.find(surface); found != assembly.surfaces.end())
      values += values_of_contact_node * static_cast<double>(found->second.size());  // about a node a facet
  };
  for (const ContactNames& contact : description.contacts) {
    add_surface(contact.slave);
    for (const std::string& master : contact.master) add_surface(master);
  }
  return values;
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
                  3.0 * static_cast<double>(description.loads.size());
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
  size.field_outputs = output.field_interval > 0 ? times_of(sizes.output_times.fields, end, steps) : 2;
  for (const scene::OutputWindow& window : output_windows)
    size.field_outputs += times_of_window(window, end, sizes.step_size);
  size.samples = times_of(sizes.output_times.history, end, steps);
  size.field_bytes = 8 * size.field_outputs * values_of_output(description, assembled.assembly);
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
      "{}: [output] {} makes {:.3g} {} of {} each: {} before compression, but {} has {} free; give a longer {}, {}, "
      "end the run (time.end = {:.4g} s) earlier, "
      "see whether the step is as long as it should be, or name a file on a larger disk",
      scene.path, fields ? "field_interval" : "history_interval", fields ? size.field_outputs : size.samples,
      fields ? "outputs of fields" : "samples of histories",
      fields ? bytes_text(size.field_bytes / size.field_outputs) : bytes_text(size.history_bytes / size.samples),
      bytes_text(fields ? size.field_bytes : size.history_bytes), scene.output.file, bytes_text(available), longer,
      fields ? "fewer field_sets or fields" : "fewer history_sets", scene.time.end));
}

double free_bytes_at(const std::string& path) {
  std::error_code failed;
  const auto space = std::filesystem::space(std::filesystem::absolute(path).parent_path(), failed);
  return failed ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

}  // namespace railwave
