#include "output/histories/history_section.hpp"

#include <iterator>
#include <stdexcept>

#include "output/histories/history_values.hpp"

namespace railwave {
namespace {

constexpr hdf5::Storage blocks{1024, false};

void write_place(const hdf5::Group& group, const char* name, const Vec3& place) {
  group.write<double>(name, {place.begin(), place.end()}, {3});
}

hdf5::Dataset quantity_in(const hdf5::Group& group, const FieldRow& row) {
  hdf5::Shape shape;
  if (row.components > 1) shape.push_back(static_cast<hsize_t>(row.components));
  return group.create_growing<double>(row.name, shape, blocks);
}

template <class Numbers>
void push(std::vector<double>& values, const Numbers& vector) {
  values.insert(values.end(), vector.begin(), vector.end());
}

}  // namespace

template <class T>
void HistorySection::Column<T>::write(hsize_t rows) {
  dataset.append(values.data(), rows);
  values.clear();
}

template <class Values>
template <class Means>
void HistorySection::QuantityColumn<Values>::push(const Means& means) {
  const double* first = values(means);
  column.values.insert(column.values.end(), first, first + components);
}

HistorySection::HistorySection(const hdf5::Group& root, const std::vector<std::string>& contacts,
                               const std::vector<std::string>& sets,
                               const std::vector<std::pair<std::string, int>>& beams,
                               const std::vector<Vec3>& positions, const std::vector<LoadNames>& loads,
                               const std::vector<std::string>& askers,
                               const std::vector<std::vector<const FieldRow*>>& motions,
                               const std::vector<HistorySet>& elements,
                               const std::vector<std::string>& prescribed_motions) {
  const hdf5::Group history = root.create_group("history");
  const hdf5::Group energy = history.create_group("energy");
  for (const EnergyTerm& term : energy_terms)
    energies_.push_back({energy.create_growing<double>(term.name, {}, blocks), {}});

  const auto vector_in = [](const hdf5::Group& group, const char* name) {
    return group.create_growing<double>(name, {3}, blocks);
  };
  const auto value_in = [](const hdf5::Group& group, const char* name) {
    return group.create_growing<double>(name, {}, blocks);
  };
  const auto count_in = [](const hdf5::Group& group, const char* name) {
    return group.create_growing<long>(name, {}, blocks);
  };
  const hdf5::Group contact_groups = history.create_group("contact");
  for (const std::string& name : contacts) {
    const hdf5::Group group = contact_groups.create_group(name);
    contacts_.push_back({{vector_in(group, "normal_force"), {}},
                         {vector_in(group, "tangential_force"), {}},
                         {vector_in(group, "master_force"), {}},
                         {count_in(group, "nodes_in_contact"), {}},
                         {count_in(group, "nodes_slipping"), {}}});
  }
  const hdf5::Group set_groups = history.create_group("set");
  const auto all_motions = fields_for(FieldRow::histories, FieldRow::Place::node);
  for (const std::string& name : sets) {
    const hdf5::Group group = set_groups.create_group(name);
    if (const std::size_t set = sets_.size(); set < askers.size() && !askers[set].empty())
      group.set_attribute("asked_by", askers[set]);
    if (const std::size_t set = sets_.size(); set < positions.size()) write_place(group, "position", positions[set]);
    auto& columns = sets_.emplace_back();
    for (const FieldRow* row : motions.empty() ? all_motions : motions[sets_.size() - 1])
      columns.push_back({row->components, motion_values(*row), {quantity_in(group, *row), {}}});
  }
  for (const HistorySet& set : elements) {
    const hdf5::Group group = set_groups.has(set.name) ? set_groups.group(set.name) : set_groups.create_group(set.name);
    if (!set.asked_by.empty()) group.set_attribute("asked_by", set.asked_by);
    if (!set.motion()) write_place(group, "position", set.element_centre);
    write_place(group, "element_centre", set.element_centre);
    if (set.of_probe()) write_place(group, "asked_position", set.asked_position);
    group.write("elements", set.elements, {set.elements.size()});
    auto& columns = elements_.emplace_back();
    for (const FieldRow* row : set.quantities_of(FieldRow::Place::element))
      columns.push_back({row->components, element_values(*row), {quantity_in(group, *row), {}}});
  }
  if (!loads.empty()) {
    const hdf5::Group load_groups = history.create_group("load");
    for (const LoadNames& load : loads) {
      const hdf5::Group group = load_groups.create_group(load.name);
      group.set_attribute("target", load.target);
      group.set_attribute("hammer", load.hammer ? 1L : 0L);
      if (load.direction != Vec3{})
        group.write("direction", std::vector<double>(load.direction.begin(), load.direction.end()), {3});
      if (load.torque)
        loads_.push_back({true, {value_in(group, "moment"), {}}, {value_in(group, "work"), {}}});
      else
        loads_.push_back({false, {vector_in(group, "force"), {}}, {value_in(group, "work"), {}}});
    }
  }
  if (!prescribed_motions.empty()) {
    const hdf5::Group motion_groups = history.create_group("prescribed_motion");
    for (const std::string& name : prescribed_motions) {
      const hdf5::Group group = motion_groups.create_group(name);
      reactions_.push_back({{vector_in(group, "reaction"), {}}, {value_in(group, "work"), {}}});
    }
  }
  if (!beams.empty()) {
    const hdf5::Group beam_groups = history.create_group("beam");
    for (const auto& [name, count] : beams) {
      const hdf5::Group group = beam_groups.create_group(name);
      const hdf5::Shape row{static_cast<hsize_t>(count), 3};
      beams_.push_back({{group.create_growing<double>("force", row, blocks), {}},
                        {group.create_growing<double>("moment", row, blocks), {}}});
    }
  }
  // Last: HDF5 writes the extents of arrays in the order in which these were made, and who reads a file that a kill
  // left amid that goes by the times (docs/results-file.md).
  steps_.dataset = history.create_growing<long>("step", {}, blocks);
  times_.dataset = history.create_growing<double>("time", {}, blocks);
}

void HistorySection::add(const HistorySample& sample) {
  if (sample.contacts.size() != contacts_.size() || sample.sets.size() != sets_.size() ||
      sample.beams.size() != beams_.size() || sample.elements.size() != elements_.size() ||
      (!loads_.empty() && sample.loads.size() != loads_.size()) ||
      (!reactions_.empty() && sample.reactions.size() != reactions_.size()))
    throw std::logic_error(
        "a history sample has other contacts, sets, beams, loads or prescribed motions than the results file was made "
        "for");
  times_.values.push_back(sample.time);
  steps_.values.push_back(sample.step);
  for (std::size_t i = 0; i < std::size(energy_terms); ++i)
    energies_[i].values.push_back(sample.energy.*energy_terms[i].value);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    push(contacts_[i].normal_force.values, sample.contacts[i].normal_force);
    push(contacts_[i].tangential_force.values, sample.contacts[i].tangential_force);
    push(contacts_[i].master_force.values, sample.contacts[i].master_force);
    contacts_[i].nodes_in_contact.values.push_back(sample.contacts[i].nodes_in_contact);
    contacts_[i].nodes_slipping.values.push_back(sample.contacts[i].nodes_slipping);
  }
  for (std::size_t i = 0; i < sets_.size(); ++i)
    for (auto& quantity : sets_[i]) quantity.push(sample.sets[i]);
  for (std::size_t i = 0; i < elements_.size(); ++i)
    for (auto& quantity : elements_[i]) quantity.push(sample.elements[i]);
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    push(beams_[i].force.values, sample.beams[i].force);
    push(beams_[i].moment.values, sample.beams[i].moment);
  }
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (loads_[i].torque)
      loads_[i].value.values.push_back(sample.loads[i].moment);
    else
      push(loads_[i].value.values, sample.loads[i].force);
    loads_[i].work.values.push_back(sample.loads[i].work);
  }
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    push(reactions_[i].force.values, sample.reactions[i].force);
    reactions_[i].work.values.push_back(sample.reactions[i].work);
  }
}

void HistorySection::write() {
  const hsize_t rows = waiting();
  for (auto& energy : energies_) energy.write(rows);
  for (auto& contact : contacts_) {
    contact.normal_force.write(rows);
    contact.tangential_force.write(rows);
    contact.master_force.write(rows);
    contact.nodes_in_contact.write(rows);
    contact.nodes_slipping.write(rows);
  }
  for (auto& set : sets_)
    for (auto& quantity : set) quantity.column.write(rows);
  for (auto& set : elements_)
    for (auto& quantity : set) quantity.column.write(rows);
  for (auto& beam : beams_) {
    beam.force.write(rows);
    beam.moment.write(rows);
  }
  for (auto& load : loads_) {
    load.value.write(rows);
    load.work.write(rows);
  }
  for (auto& reaction : reactions_) {
    reaction.force.write(rows);
    reaction.work.write(rows);
  }
  steps_.write(rows);
  times_.write(rows);
}

}  // namespace railwave
