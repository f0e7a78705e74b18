#include "output/fields/field_section.hpp"

#include <algorithm>
#include <stdexcept>

namespace railwave {

FieldSection::FieldSection(const hdf5::Group& fields_group, const OutputSet& set,
                           const std::vector<std::string>& fields, const NumberFormat& format)
    : set_(set), format_(format) {
  const hdf5::Group group = fields_group.create_group(set.name);
  const hsize_t nodes = set.nodes.size(), elements = set.elements.size();
  group.set_attribute("kind", set.is_beam() ? "beam" : set.is_surface() ? "surface" : "volume");
  group.write("nodes", set.nodes, {nodes});
  group.write("elements", set.elements, {elements});
  group.write("connectivity", set.corners, {elements, static_cast<hsize_t>(set.corner_count)});
  group.write("coordinates", set.coordinates, {nodes, 3});
  if (set.is_beam()) {
    forces_ = group.create_growing<double>("force", {elements, 3}, each_time);
    moments_ = group.create_growing<double>("moment", {elements, 3}, each_time);
  }
  for (const std::string& name : fields) {
    const FieldRow& row = field_named(name);
    if (!set.has(row)) continue;
    hdf5::Shape shape{set.numbers(row).size()};
    if (row.components > 1) shape.push_back(static_cast<hsize_t>(row.components));
    columns_.push_back({&row, format.make_growing(group, name, shape, each_time)});
  }
  steps_ = group.create_growing<long>("step", {}, times_in_block);
  times_ = group.create_growing<double>("time", {}, times_in_block);  // last, see HistorySection
  std::stable_partition(columns_.begin(), columns_.end(), [](const Column& one) { return one.field->of_nodes(); });
}

std::vector<double> FieldSection::values_of(const Column& column, const FieldSource& source) const {
  const std::vector<int>& numbers = set_.numbers(*column.field);
  HostField field = source.field(*column.field, numbers);
  if (field.components != column.field->components || field.values.size() != numbers.size() * field.components)
    throw std::logic_error("the fields of " + set_.name + " have not the length of the set");
  format_.round(column.field->name, field.values);
  return std::move(field.values);
}

void FieldSection::add_rows(const FieldSource& source, CompressedRows& rows) const {
  for (const Column& column : columns_)
    rows.add(column.dataset, [this, &column, &source] { return values_of(column, source); });
}

void FieldSection::add_values(const FieldSource& source, long step, const CompressedRows& packed) {
  for (Column& column : columns_)
    if (!packed.append_to(column.dataset)) column.dataset.append(values_of(column, source).data(), 1);
  if (set_.is_beam()) add_section_forces(source);
  steps_.append(&step, 1);
}

void FieldSection::add_section_forces(const FieldSource& source) {
  const HostField all = source.beams();
  std::vector<double> force, moment;
  for (const int element : set_.elements) {
    if (all.values.size() < 6u * (element + 1))
      throw std::logic_error("the section forces of " + set_.name + " are missing");
    const auto own = all.values.begin() + 6 * element;
    force.insert(force.end(), own, own + 3);
    moment.insert(moment.end(), own + 3, own + 6);
  }
  forces_.append(force.data(), 1);
  moments_.append(moment.data(), 1);
}

}  // namespace railwave
