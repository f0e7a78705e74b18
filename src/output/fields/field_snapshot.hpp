#pragma once

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "case/field_table.hpp"
#include "model/contact/contact_state.hpp"
#include "model/fields.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/output_sets.hpp"

namespace railwave {

/// How datasets lie that grow by a row at each output of fields: large rows one by one, the times many together.
inline constexpr hdf5::Storage each_time{1, true};
inline constexpr hdf5::Storage times_in_block{1024, false};

/// Which output sets and contacts have an output.
struct OutputChoice {
  std::vector<bool> sets, contacts;

  static OutputChoice all(std::size_t set_count, std::size_t contact_count) {
    return {std::vector<bool>(set_count, true), std::vector<bool>(contact_count, true)};
  }
  static OutputChoice none(std::size_t set_count, std::size_t contact_count) {
    return {std::vector<bool>(set_count), std::vector<bool>(contact_count)};
  }
  /// What either has, of as many sets and contacts.
  void add(const OutputChoice& other) {
    for (std::size_t s = 0; s < sets.size(); ++s) sets[s] = sets[s] || other.sets[s];
    for (std::size_t c = 0; c < contacts.size(); ++c) contacts[c] = contacts[c] || other.contacts[c];
  }
  bool operator<(const OutputChoice& other) const {
    return std::tie(sets, contacts) < std::tie(other.sets, other.contacts);
  }
};

/// Where the results file gets its fields from: the running model, or in a test a made-up one. All at one instant.
class FieldSource {
 public:
  virtual ~FieldSource() = default;
  /// @param numbers of nodes or elements, whichever the field belongs to
  virtual HostField field(const FieldRow& row, const std::vector<int>& numbers) const = 0;
  virtual ContactState contact(int number) const = 0;
  /// Section forces and moments of all elements of beams, N and N m: six components.
  virtual HostField beams() const { return {6, {}}; }
};

/// Which fields a results file takes from a FieldSource at an output, and of which nodes and elements: those of all
/// output sets together, each once, so that every field is fetched once; and of which contacts the state.
struct FieldSelection {
  std::vector<int> nodes, elements;                  ///< model numbers, ascending
  std::vector<int> place_of_node, place_of_element;  ///< by model number up to the largest: position in those, or -1
  std::vector<const FieldRow*> fields;
  bool beams = false;
  std::vector<bool> contacts;

  const std::vector<int>& numbers(const FieldRow& row) const { return row.of_nodes() ? nodes : elements; }
  /// Of the fields of nodes and elements in a snapshot.
  std::size_t bytes() const;
};

/// @param fields names of case/field_table.hpp
FieldSelection select_fields(const std::vector<OutputSet>& sets, const std::vector<std::string>& fields,
                             const OutputChoice& choice);

/// The selected fields of one instant, fetched once and kept as plain data: it outlives the instant, and any thread may
/// read it.
class FieldSnapshot : public FieldSource {
 public:
  FieldSnapshot(const FieldSource& source, std::shared_ptr<const FieldSelection> selection);

  /// Throws std::logic_error for what was not selected.
  HostField field(const FieldRow& row, const std::vector<int>& numbers) const override;
  ContactState contact(int number) const override { return contacts_.at(number); }
  HostField beams() const override { return beams_; }

 private:
  std::shared_ptr<const FieldSelection> selection_;
  std::vector<HostField> fields_;  ///< one for each of selection_->fields
  HostField beams_;                ///< without components where not selected
  std::vector<ContactState> contacts_;
};

}  // namespace railwave
