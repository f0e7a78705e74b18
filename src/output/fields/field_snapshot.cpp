#include "output/fields/field_snapshot.hpp"

#include <algorithm>
#include <stdexcept>

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
  std::size_t values = 0;
  for (const FieldRow* row : fields) values += static_cast<std::size_t>(row->components) * numbers(*row).size();
  return sizeof(double) * values;
}

FieldSelection select_fields(const std::vector<OutputSet>& sets, const std::vector<std::string>& fields,
                             const OutputChoice& choice) {
  FieldSelection selection;
  selection.contacts = choice.contacts;
  bool wants_nodes = false, wants_elements = false;
  for (const std::string& name : fields) {
    const FieldRow& row = field_named(name);
    selection.fields.push_back(&row);
    (row.of_nodes() ? wants_nodes : wants_elements) = true;
  }
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (!choice.sets[s]) continue;
    const OutputSet& set = sets[s];
    if (wants_nodes) append(selection.nodes, set.nodes);
    if (set.is_beam())
      selection.beams = true;
    else if (wants_elements)
      append(selection.elements, set.elements);
  }
  selection.place_of_node = sort_and_place(selection.nodes);
  selection.place_of_element = sort_and_place(selection.elements);
  return selection;
}

FieldSnapshot::FieldSnapshot(const FieldSource& source, std::shared_ptr<const FieldSelection> selection)
    : selection_(std::move(selection)) {
  for (const FieldRow* row : selection_->fields) fields_.push_back(source.field(*row, selection_->numbers(*row)));
  if (selection_->beams) beams_ = source.beams();
  for (std::size_t i = 0; i < selection_->contacts.size(); ++i)
    contacts_.push_back(selection_->contacts[i] ? source.contact(static_cast<int>(i)) : ContactState());
}

HostField FieldSnapshot::field(const FieldRow& row, const std::vector<int>& numbers) const {
  const auto& selected = selection_->fields;
  const auto found = std::find(selected.begin(), selected.end(), &row);
  if (found == selected.end()) throw std::logic_error(not_selected);
  return pick(fields_[found - selected.begin()],
              row.of_nodes() ? selection_->place_of_node : selection_->place_of_element, numbers);
}

}  // namespace railwave
