#include "post/field_sets.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "case/field_table.hpp"

namespace railwave {
namespace {

void check_mesh(const FieldSet& set) {
  if (set.coordinates.size() != 3 * set.node_count() || set.connectivity.size() != set.corner_count * set.cell_count())
    throw std::runtime_error(set.name + ": its coordinates, cells and numbers do not fit together");
  const long nodes = static_cast<long>(set.node_count());
  for (const long corner : set.connectivity)
    if (corner < 0 || corner >= nodes) throw std::runtime_error(set.name + ": a cell has a corner that is no node");
}

void find_fields(FieldSet& set) {
  for (const FieldRow* row : fields_for(FieldRow::fields))
    if (set.group.has(row->name))
      set.fields.push_back({row->name, row->of_nodes(), static_cast<std::size_t>(row->components)});
  if (!set.is_beam()) return;
  set.fields.push_back({"force", false, 3});
  set.fields.push_back({"moment", false, 3});
}

/// A kill in the middle of a flush may leave the arrays with different lengths.
void find_times(FieldSet& set) {
  set.times = set.group.dataset("time").read<double>();
  for (const SetField& field : set.fields)
    set.times.resize(std::min(set.times.size(), static_cast<std::size_t>(set.group.dataset(field.name).shape().at(0))));
  for (std::size_t k = 0; k < set.times.size(); ++k)
    if (k == 0 ? set.times[k] != set.times[k] : !(set.times[k] > set.times[k - 1]))
      throw std::runtime_error(set.name + ": its output times do not ascend");
}

void add_sets(std::vector<FieldSet>& sets, const hdf5::Group& parent) {
  for (const std::string& name : parent.names()) {
    FieldSet set;
    set.name = name;
    set.group = parent.group(name);
    const hdf5::Shape shape = set.group.dataset("connectivity").shape();
    if (shape.size() != 2 || (shape[1] != 2 && shape[1] != 4 && shape[1] != 8))
      throw std::runtime_error(name + ": its cells have another shape");
    if (shape[0] == 0) continue;
    set.corner_count = static_cast<std::size_t>(shape[1]);
    set.coordinates = set.group.dataset("coordinates").read<double>();
    set.connectivity = set.group.dataset("connectivity").read<long>();
    set.nodes = set.group.dataset("nodes").read<long>();
    set.elements = set.group.dataset("elements").read<long>();
    check_mesh(set);
    find_fields(set);
    find_times(set);
    sets.push_back(std::move(set));
  }
}

}  // namespace

const SetField* FieldSet::field(const std::string& wanted) const {
  for (const SetField& field : fields)
    if (field.name == wanted) return &field;
  return nullptr;
}

std::vector<double> FieldSet::values(const SetField& field, std::size_t output) const {
  std::vector<double> values = group.dataset(field.name).read_row<double>(output);
  const std::size_t entries = field.of_nodes ? node_count() : cell_count();
  if (values.size() != entries * field.components)
    throw std::runtime_error(fmt::format("{} of {} has {} values where {} are wanted", field.name, name, values.size(),
                                         entries * field.components));
  return values;
}

std::vector<FieldSet> read_field_sets(const ResultsReader& results) {
  return results.report_damage([&] {
    std::vector<FieldSet> sets;
    for (const char* parent : {"fields", "beams"})
      if (results.root().has(parent)) add_sets(sets, results.root().group(parent));
    return sets;
  });
}

bool is_within(const FieldSet& one, const FieldSet& other) {
  if (one.is_beam() != other.is_beam()) return false;
  std::vector<long> inner = one.elements, outer = other.elements;
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  std::sort(outer.begin(), outer.end());
  return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
}

}  // namespace railwave
