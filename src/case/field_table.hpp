#pragma once

#include <string>
#include <vector>

namespace railwave {

/// A quantity of nodes or elements that a run may write.
struct FieldRow {
  enum class Place { node, element };
  enum Use : unsigned { fields = 1, histories = 2 };

  const char* name;     ///< in the case, and of the dataset in the results
  Place place;          ///< what an entry belongs to
  int components;       ///< values of an entry: 1, 3 (a vector) or 6 (a tensor: xx, yy, zz, xy, yz, zx)
  const char* unit;     ///< SI; "1" of numbers
  unsigned uses;        ///< `fields`: output.fields may name it; `histories`: so may the quantities of a probe
  const char* meaning;  ///< for the reference page; empty where the name says all

  bool of_nodes() const { return place == Place::node; }
  bool of_elements() const { return place == Place::element; }
  bool serves(Use use) const { return (uses & use) != 0; }
};

/// The one table of these. The case's keys and their help, the results with their units and the estimate of their size,
/// the XDMF companion, fault files and the names of channels all follow from it. What fetches the values of a field is
/// in model/output_field.cpp, that of a history in output/histories/history_values.cpp: a new row needs an entry there,
/// and nothing else.
const std::vector<FieldRow>& field_table();

/// The rows that serve one use, in the table's order.
std::vector<const FieldRow*> fields_for(FieldRow::Use use);
std::vector<const FieldRow*> fields_for(FieldRow::Use use, FieldRow::Place place);

/// The row of that name; null where there is none.
const FieldRow* find_field(const std::string& name);

/// The same; throws std::logic_error where there is none.
const FieldRow& field_named(const std::string& name);

std::vector<std::string> names_of(const std::vector<const FieldRow*>& rows);

/// A quantity of the nodes of contact surfaces that a run may write. What computes it is in
/// output/fields/contact_values.cpp, its unit in output/dataset_units.cpp.
struct ContactFieldRow {
  const char* name;  ///< in the case, and of the dataset in the results
  int components;
  bool of_slave_only;
  const char* meaning;  ///< for the reference page; empty where the name says all
};

/// The one table of these.
const std::vector<ContactFieldRow>& contact_field_table();
std::vector<std::string> contact_field_names();

/// "`area`; `position`; ...": the table for the help of a key.
std::string contact_fields_help();

/// "Of nodes: `displacement` (m): ...; ... Of elements: ...": the rows of one use for the help of a key.
std::string fields_help(FieldRow::Use use);

}  // namespace railwave
