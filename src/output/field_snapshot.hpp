#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/field_source.hpp"
#include "output/output_sets.hpp"

namespace railwave {

/// Which fields a results file takes from a FieldSource at each output, and of which nodes and elements: those of all
/// output sets and contact surfaces together, each once, so that every field is fetched once.
struct FieldSelection {
  std::vector<int> nodes, elements;                  ///< model numbers, ascending
  std::vector<int> place_of_node, place_of_element;  ///< by model number up to the largest: position in those, or -1
  std::vector<NodeField> node_fields;
  bool stress = false, plastic_strain = false, beams = false;
  int contact_count = 0;

  /// Of the fields of nodes and elements in a snapshot.
  std::size_t bytes() const;
};

/// `fields`: of displacement, velocity, acceleration, stress, plastic_strain. The contacts' nodes are taken from
/// `source`.
FieldSelection select_fields(const std::vector<OutputSet>& sets, const std::vector<std::string>& fields,
                             int contact_count, const FieldSource& source);

/// The selected fields of one instant, fetched once and kept as plain data: it outlives the instant, and any thread may
/// read it.
class FieldSnapshot : public FieldSource {
 public:
  FieldSnapshot(const FieldSource& source, std::shared_ptr<const FieldSelection> selection);

  /// These throw std::logic_error for what was not selected.
  HostField nodes(NodeField field, const std::vector<int>& node_numbers) const override;
  HostField stress(const std::vector<int>& element_numbers) const override;
  HostField plastic_strain(const std::vector<int>& element_numbers) const override;
  ContactState contact(int number) const override { return contacts_.at(number); }
  HostField beams() const override { return beams_; }

 private:
  std::shared_ptr<const FieldSelection> selection_;
  std::vector<HostField> node_fields_;         ///< one for each of selection_->node_fields
  HostField stress_, plastic_strain_, beams_;  ///< without components where not selected
  std::vector<ContactState> contacts_;
};

}  // namespace railwave
