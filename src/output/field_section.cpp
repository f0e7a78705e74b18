#include "output/field_section.hpp"

#include <stdexcept>

#include "output/field_names.hpp"

namespace railwave {
namespace {

constexpr hdf5::Storage each_time{1, true};
constexpr hdf5::Storage times_in_block{1024, false};

void append(hdf5::Dataset& dataset, const HostField& field, std::size_t entries, int components,
            const std::string& name) {
  if (field.components != components || field.values.size() != entries * components)
    throw std::logic_error("the fields of " + name + " have not the length of the set");
  dataset.append(field.values.data(), 1);
}

}  // namespace

FieldSection::FieldSection(const hdf5::Group& fields_group, const OutputSet& set,
                           const std::vector<std::string>& fields)
    : set_(set) {
  const hdf5::Group group = fields_group.create_group(set.name);
  const hsize_t nodes = set.nodes.size(), elements = set.elements.size();
  group.set_attribute("kind", set.is_beam() ? "beam" : set.is_surface() ? "surface" : "volume");
  group.write("nodes", set.nodes, {nodes});
  group.write("elements", set.elements, {elements});
  group.write("connectivity", set.corners, {elements, static_cast<hsize_t>(set.corner_count)});
  group.write("coordinates", set.coordinates, {nodes, 3});
  times_ = group.create_growing<double>("time", {}, times_in_block);
  steps_ = group.create_growing<long>("step", {}, times_in_block);
  if (set.is_beam()) {
    forces_ = group.create_growing<double>("force", {elements, 3}, each_time);
    moments_ = group.create_growing<double>("moment", {elements, 3}, each_time);
  }
  for (const std::string& name : fields) {
    const bool of_element = name == "stress" || name == "plastic_strain";
    if (of_element && set.is_beam()) continue;
    if (name == "stress") {
      element_columns_.push_back(
          {&FieldSource::stress, 6, group.create_growing<double>(name, {elements, 6}, each_time)});
    } else if (name == "plastic_strain") {
      element_columns_.push_back(
          {&FieldSource::plastic_strain, 1, group.create_growing<double>(name, {elements}, each_time)});
    } else {
      node_columns_.push_back({node_field_named(name), group.create_growing<double>(name, {nodes, 3}, each_time)});
    }
  }
}

void FieldSection::add_values(const FieldSource& source, long step) {
  for (NodeColumn& column : node_columns_)
    append(column.dataset, source.nodes(column.field, set_.nodes), set_.nodes.size(), 3, set_.name);
  for (ElementColumn& column : element_columns_)
    append(column.dataset, (source.*column.fetch)(set_.elements), set_.elements.size(), column.components, set_.name);
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
