#include "output/field_snapshot.hpp"

#include <algorithm>
#include <stdexcept>

#include "output/field_names.hpp"

namespace railwave {
namespace {

constexpr const char* not_selected = "a field, node or element was not selected when the snapshot was taken";

/// Position in the sorted list without repetitions that `numbers` becomes, by number; -1 for those not in it.
std::vector<int> sort_and_place(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<int> place(numbers.empty() ? 0 : numbers.back() + 1, -1);
  for (std::size_t i = 0; i < numbers.size(); ++i) place[numbers[i]] = static_cast<int>(i);
  return place;
}

void append(std::vector<int>& all, const std::vector<int>& more) { all.insert(all.end(), more.begin(), more.end()); }

HostField pick(const HostField& all, const std::vector<int>& place, const std::vector<int>& numbers) {
  if (all.components == 0) throw std::logic_error(not_selected);
  const std::size_t components = all.components;
  HostField picked{all.components, std::vector<double>(components * numbers.size())};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t number = numbers[i];
    if (number >= place.size() || place[number] < 0) throw std::logic_error(not_selected);
    std::copy_n(all.values.begin() + components * place[number], components, picked.values.begin() + components * i);
  }
  return picked;
}

}  // namespace

std::size_t FieldSelection::bytes() const {
  const std::size_t of_node = 3 * node_fields.size(), of_element = (stress ? 6 : 0) + (plastic_strain ? 1 : 0);
  return sizeof(double) * (of_node * nodes.size() + of_element * elements.size());
}

FieldSelection select_fields(const std::vector<OutputSet>& sets, const std::vector<std::string>& fields,
                             int contact_count, const FieldSource& source) {
  FieldSelection selection;
  selection.contact_count = contact_count;
  bool wants_nodes = false;
  for (const std::string& name : fields) {
    if (name == "stress")
      selection.stress = true;
    else if (name == "plastic_strain")
      selection.plastic_strain = true;
    else {
      selection.node_fields.push_back(node_field_named(name));
      wants_nodes = true;
    }
  }
  for (const OutputSet& set : sets) {
    if (wants_nodes) append(selection.nodes, set.nodes);
    if (set.is_beam())
      selection.beams = true;
    else if (selection.stress || selection.plastic_strain)
      append(selection.elements, set.elements);
  }
  for (int i = 0; i < contact_count; ++i) {
    const ContactState state = source.contact(i);
    append(selection.nodes, state.slave.nodes);
    append(selection.nodes, state.master.nodes);
  }
  // The contact surfaces are written with their displacement, whatever fields the sets are to have.
  auto& of_nodes = selection.node_fields;
  if (contact_count > 0 && std::find(of_nodes.begin(), of_nodes.end(), NodeField::displacement) == of_nodes.end())
    of_nodes.push_back(NodeField::displacement);
  selection.place_of_node = sort_and_place(selection.nodes);
  selection.place_of_element = sort_and_place(selection.elements);
  return selection;
}

FieldSnapshot::FieldSnapshot(const FieldSource& source, std::shared_ptr<const FieldSelection> selection)
    : selection_(std::move(selection)) {
  for (const NodeField field : selection_->node_fields) node_fields_.push_back(source.nodes(field, selection_->nodes));
  if (selection_->stress) stress_ = source.stress(selection_->elements);
  if (selection_->plastic_strain) plastic_strain_ = source.plastic_strain(selection_->elements);
  if (selection_->beams) beams_ = source.beams();
  for (int i = 0; i < selection_->contact_count; ++i) contacts_.push_back(source.contact(i));
}

HostField FieldSnapshot::nodes(NodeField field, const std::vector<int>& node_numbers) const {
  const auto& fields = selection_->node_fields;
  const auto found = std::find(fields.begin(), fields.end(), field);
  if (found == fields.end()) throw std::logic_error(not_selected);
  return pick(node_fields_[found - fields.begin()], selection_->place_of_node, node_numbers);
}

HostField FieldSnapshot::stress(const std::vector<int>& element_numbers) const {
  return pick(stress_, selection_->place_of_element, element_numbers);
}

HostField FieldSnapshot::plastic_strain(const std::vector<int>& element_numbers) const {
  return pick(plastic_strain_, selection_->place_of_element, element_numbers);
}

}  // namespace railwave
